#include "docent/simulator/museum_folder/places.h"

#include <gtest/gtest.h>

#include "docent/base/files.h"

namespace docent::simulator {
namespace {

Result<Places> places_of(const std::string& text) {
  const auto path = std::filesystem::path{testing::TempDir()} / "places.yaml";
  EXPECT_TRUE(write_file_atomically(path, text).has_value());
  return load_places(path);
}

const std::string kTwo =
    "exhibits:\n"
    "  - {id: engine, title: {en: \"The engine\", de: \"Der Motor\"}, pose: {x: 3, y: 4, heading: 90}}\n"
    "  - {id: wheel, text: {en: \"It turns.\", de: \"Es dreht sich.\"}, pose: {x: 1, y: 2, heading: 0}, look_at: {x: "
    "2, "
    "y: 5}}\n";

TEST(Places, EachThingIsSaidOnce) {
  const auto places = places_of("languages: [en, de]\nhome: {x: 1, y: 2, heading: 90}\n" + kTwo +
                                "hazards:\n  - {id: steps, kind: stairs, polygon: [[5, 7], [6, 5], [5, 5]]}\n");
  ASSERT_TRUE(places.has_value()) << places.error().message;
  ASSERT_EQ(places->stops.size(), 2U);
  EXPECT_EQ(places->stops[0].title.at("de"), "Der Motor");
  EXPECT_NEAR(distance(places->stops[0].look_at, {3.0, 5.0}), 0.0, 1e-9) << "straight ahead where nothing is said";
  EXPECT_EQ(places->stops[1].text.at("en"), "It turns.");
  EXPECT_EQ(places->stops[1].look_at, (Point2{2.0, 5.0}));
  ASSERT_EQ(places->hazards.size(), 1U);
  EXPECT_EQ(places->hazards[0].kind, SolidKind::stairs);
  EXPECT_GT(signed_area(places->hazards[0].polygon), 0.0) << "corners counter-clockwise, however they were written";
  EXPECT_TRUE(places->home.has_value());
  EXPECT_FALSE(places->charger.has_value());
}

TEST(Places, HazardsMayBeAbsent) {
  const auto places = places_of("languages: [en, de]\n" + kTwo);
  ASSERT_TRUE(places.has_value()) << places.error().message;
  EXPECT_TRUE(places->hazards.empty());
}

TEST(Places, FaultsNameFileAndLine) {
  const std::string head = "languages: [en, de]\n";
  for (const auto& [text, says] : std::vector<std::pair<std::string, std::string>>{
           {"languages: [en]\n", "exhibits"},
           {head + kTwo + "floor: 3\n", "places.yaml:5: "},
           {head +
                "exhibits:\n  - {id: a, pose: {x: 1, y: 2, heading: 0}}\n  - {id: a, pose: {x: 1, y: 2, heading: 0}}\n",
            "places.yaml:4: id 'a' stands here twice"},
           {head + "exhibits:\n  - {id: a, pose: {x: 1, y: 2, heading: 0}}\n  - {id: b}\n", "places.yaml:4: "},
           {head + "exhibits:\n  - {id: a, title: {en: A}, pose: {x: 1, y: 2, heading: 0}}\n  - {id: b, pose: {x: 1, "
                   "y: 2, heading: 0}}\n",
            "nothing in 'de'"},
           {head + kTwo + "hazards:\n  - {id: h, kind: lava, polygon: [[0, 0], [1, 0], [1, 1]]}\n", "lava"},
           {head + kTwo + "hazards:\n  - {id: h, kind: glass, polygon: [[0, 0], [1, 1]]}\n", "places.yaml:6: "},
       }) {
    const auto places = places_of(text);
    ASSERT_FALSE(places.has_value()) << text;
    EXPECT_NE(places.error().message.find(says), std::string::npos) << places.error().message;
  }
}

}  // namespace
}  // namespace docent::simulator
