#include "docent/museum/museum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "docent/base/files.h"

namespace docent::museum {
namespace {

// A hall of 10 x 8 m with a wall inside that leaves a door, a closet that no disc can enter, and a glass case.
const char* const kMuseum = R"(name: {en: "Small museum", de: "Kleines Museum"}
languages: [en, de]
map: map.yaml
area: [[0.4, 0.4], [9.6, 0.4], [9.6, 7.6], [0.4, 7.6]]
hazards:
  - {id: case, kind: glass, polygon: [[3.0, 3.0], [4.0, 3.0], [4.0, 4.0], [3.0, 4.0]]}
  - {id: steps, kind: stairs, polygon: [[8.0, 1.0], [9.0, 1.0], [9.0, 2.0]]}
home: {x: 1.0, y: 1.0, heading: 90}
charger: {x: 1.0, y: 2.0, heading: 0}
exhibits:
  - id: clock
    title: {en: "The clock", de: "Die Uhr"}
    pose: {x: 3.5, y: 2.0, heading: 90}
    look_at: {x: 3.5, y: 3.5}
    viewpoints: [{x: 2.0, y: 3.5, heading: 0}, {x: 4.8, y: 3.6, heading: 180}]
    short: {en: content/clock.en.md, de: content/clock.de.md}
    topics: [time, metal]
  - id: coin
    title: {en: "The coin", de: "Die Münze"}
    pose: {x: 7.5, y: 3.5, heading: 0}
    look_at: {x: 8.5, y: 3.5}
    short: {en: content/coin.en.md, de: content/coin.de.md}
    long: {en: content/coin.long.en.md, de: content/coin.long.de.md}
    topics: [metal]
  - id: staff
    title: {en: "The staff", de: "Die Leute"}
    pose: {x: 7.5, y: 2.9, heading: 0}
    look_at: {x: 8.5, y: 2.9}
    short: {en: content/staff.en.md, de: content/staff.de.md}
    topics: [metal]
    web_only: true
modes:
  open: {max_speed: 0.6}
  web: {max_speed: 0.3, wait_s: 30, hours: ["20:00-22:00"]}
tours:
  - {id: all, title: {en: "All", de: "Alles"}, exhibits: [clock, coin]}
  - {id: quick, title: {en: "Quick", de: "Schnell"}, minutes: 6}
)";

OccupancyGrid small_map() {
  OccupancyGrid map;
  map.frame = {200, 160, 0.05, {0.0, 0.0}};
  map.cells.assign(map.frame.size(), OccupancyGrid::kFree);
  const auto wall = [&](double x0, double y0, double x1, double y1, std::int8_t value) {
    for (int row = 0; row < map.frame.rows; ++row) {
      for (int column = 0; column < map.frame.columns; ++column) {
        const Point2 centre = map.frame.centre({column, row});
        if (centre.x >= x0 && centre.x <= x1 && centre.y >= y0 && centre.y <= y1) {
          map.cells[map.frame.index({column, row})] = value;
        }
      }
    }
  };
  wall(0.0, 0.0, 10.0, 0.2, OccupancyGrid::kOccupied);
  wall(0.0, 7.8, 10.0, 8.0, OccupancyGrid::kOccupied);
  wall(0.0, 0.0, 0.2, 8.0, OccupancyGrid::kOccupied);
  wall(9.8, 0.0, 10.0, 8.0, OccupancyGrid::kOccupied);
  wall(6.0, 2.0, 6.2, 8.0, OccupancyGrid::kOccupied);   // a wall; one passes below it
  wall(6.2, 5.0, 10.0, 5.2, OccupancyGrid::kOccupied);  // a closet above: no door
  wall(0.2, 6.0, 1.5, 7.8, OccupancyGrid::kUnknown);    // a corner that was never seen
  return map;
}

/// A museum in a folder of its own, gone at the end.
class SmallMuseum {
 public:
  SmallMuseum() {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              ("docent-museum-" + std::string{test->name()} + "-" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_ / "content");
    for (const char* name :
         {"clock.en", "clock.de", "coin.en", "coin.de", "coin.long.en", "coin.long.de", "staff.en", "staff.de"}) {
      write("content/" + std::string{name} + ".md", std::string{"This is "} + name + ".\n");
    }
    EXPECT_TRUE(save_map(small_map(), folder_ / "map"));
    write("museum.yaml", kMuseum);
  }
  SmallMuseum(const SmallMuseum&) = delete;
  SmallMuseum& operator=(const SmallMuseum&) = delete;
  ~SmallMuseum() { std::filesystem::remove_all(folder_); }

  void write(const std::string& name, const std::string& content) const {
    EXPECT_TRUE(write_file_atomically(folder_ / name, content));
  }
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path folder_;
};

/// The line of the first fault that differs: where `part` stands in `text`, counted from 1.
int line_of(const std::string& text, const std::string& part) {
  const auto at = text.find(part);
  EXPECT_NE(at, std::string::npos) << part;
  return 1 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
}

struct Broken {
  const char* name;
  const char* from;         ///< in kMuseum
  const char* to;           ///< instead
  const char* where;        ///< a part of the changed text whose line the fault must name
  const char* why;          ///< a part of the fault
  bool only_check = false;  ///< load_museum does not look at it
};

std::ostream& operator<<(std::ostream& stream, const Broken& broken) { return stream << broken.name; }

const Broken kBroken[]{
    {"UnknownKey", "map: map.yaml", "map: map.yaml\ncolour: red", "colour", "unknown key 'colour'"},
    {"UnknownKeyInExhibit", "topics: [time, metal]", "topics: [time]\n    price: 3", "price", "unknown key 'price'"},
    {"UnknownKeyInPose", "home: {x: 1.0,", "home: {z: 0, x: 1.0,", "home:", "unknown key 'z'"},
    {"KeyTwice", "map: map.yaml", "map: map.yaml\nmap: other.yaml", "map: other", "key 'map' stands twice"},
    {"NotYaml", "languages: [en, de]", "languages: [en, de", "map:", "not valid YAML"},
    {"NotAMapping", kMuseum, "- a\n- b\n", "- a", "expected a mapping"},
    {"Empty", kMuseum, "\n", "", "missing key"},
    {"MissingName", "name: {en: \"Small museum\", de: \"Kleines Museum\"}", "", "", "missing key 'name'"},
    {"MissingHome", "home: {x: 1.0, y: 1.0, heading: 90}", "", "name:", "missing key 'home'"},
    {"MissingArea", "area:", "# area:", "name:", "missing key 'area'"},
    {"MissingExhibits", "exhibits:\n  - id: clock", "exhibits: []\nx:\n  - id: clock", "exhibits: []", "at least one"},
    {"ExhibitsNoList", "exhibits:\n  - id: clock", "exhibits: 3\nx:\n  - id: clock", "exhibits: 3", "list of exhibits"},
    {"NoLanguage", "languages: [en, de]", "languages: []", "languages", "at least one language"},
    {"UnknownLanguage", "languages: [en, de]", "languages: [en, xx]", "languages", "unknown language 'xx'"},
    {"LanguageTwice", "languages: [en, de]", "languages: [en, de, en]", "languages", "'en' stands twice"},
    {"LinkOfAnotherKind", "topics: [time, metal]",
     "topics: [time]\n    links: [{title: {en: \"A\", de: \"B\"}, url: \"javascript:alert(1)\"}]", "url",
     "must begin with http"},
    {"LinkWithoutATitle", "topics: [time, metal]", "topics: [time]\n    links: [{url: \"https://a.test\"}]", "links",
     "title"},
    {"PictureOutside", "topics: [time, metal]", "topics: [time]\n    picture: ../clock.png", "picture",
     "not a file inside"},
    {"PictureOfAnotherKind", "topics: [time, metal]", "topics: [time]\n    picture: content/clock.gif", "picture",
     "picture must be"},
    {"PictureMissing", "topics: [time, metal]", "topics: [time]\n    picture: content/clock.png", "picture",
     "does not exist", true},
    {"TitleLacksLanguage", "title: {en: \"The coin\", de: \"Die Münze\"}", "title: {en: \"The coin\"}", "The coin",
     "'de' is missing"},
    {"TitleOfAnotherLanguage", "de: \"Die Münze\"", "fr: \"La pièce\"", "La pièce", "'fr' is not one of"},
    {"TitleEmpty", "de: \"Die Münze\"", "de: \"\"", "The coin", "empty in language 'de'"},
    {"MissingTitle", "    title: {en: \"The coin\", de: \"Die Münze\"}\n", "", "id: coin", "missing key 'title'"},
    {"TextLacksLanguage", "short: {en: content/coin.en.md, de: content/coin.de.md}", "short: {en: content/coin.en.md}",
     "short: {en: content/coin.en.md}", "'de' is missing"},
    {"TextFileMissing", "content/coin.long.de.md", "content/none.md", "content/none.md", "cannot be read"},
    {"TextOutsideFolder", "content/coin.long.de.md", "content/../../coin.md", "coin.md", "not a file inside"},
    {"TextAbsolute", "content/coin.long.de.md", "/etc/hostname", "/etc/hostname", "not a file inside"},
    {"MapMissing", "map: map.yaml", "map: plan.yaml", "map:", "plan.yaml does not exist"},
    {"MapOutsideFolder", "map: map.yaml", "map: ../map.yaml", "map:", "not a file inside"},
    {"AreaTwoCorners", "[[0.4, 0.4], [9.6, 0.4], [9.6, 7.6], [0.4, 7.6]]", "[[0.4, 0.4], [9.6, 0.4]]",
     "area:", "at least 3 corners"},
    {"AreaCrossesItself", "[9.6, 7.6], [0.4, 7.6]]", "[0.4, 7.6], [9.6, 7.6]]", "area:", "crosses itself"},
    {"AreaNoNumbers", "[9.6, 7.6], [0.4, 7.6]]", "[9.6, high], [0.4, 7.6]]", "area:", "expected numbers"},
    {"AreaNotFinite", "[9.6, 7.6], [0.4, 7.6]]", "[9.6, .nan], [0.4, 7.6]]", "area:", "not a number"},
    {"AreaFlat", "[[0.4, 0.4], [9.6, 0.4], [9.6, 7.6], [0.4, 7.6]]", "[[1, 1], [2, 1], [3, 1]]", "area:", "no area"},
    {"HazardTwoCorners", "[[8.0, 1.0], [9.0, 1.0], [9.0, 2.0]]", "[[8.0, 1.0], [9.0, 1.0]]", "steps",
     "at least 3 corners"},
    {"HazardCrossesItself", "[4.0, 4.0], [3.0, 4.0]]", "[3.0, 4.0], [4.0, 4.0]]", "case", "crosses itself"},
    {"HazardKind", "kind: stairs", "kind: lava", "lava", "unknown kind 'lava'"},
    {"HazardTwice", "id: steps", "id: case", "stairs", "hazard 'case' stands twice"},
    {"HazardWithoutId", "{id: steps, kind", "{kind", "stairs", "missing key 'id'"},
    {"HomeOutsideArea", "home: {x: 1.0, y: 1.0,", "home: {x: 1.0, y: 0.3,", "home", "home lies outside the area", true},
    {"HomeInWall", "home: {x: 1.0, y: 1.0,", "home: {x: 6.1, y: 4.0,", "home", "home lies inside a wall", true},
    {"HomeNoNumber", "home: {x: 1.0, y: 1.0,", "home: {x: here, y: 1.0,", "home", "expected a number"},
    {"HomeFarAway", "home: {x: 1.0, y: 1.0,", "home: {x: 1.0e9, y: 1.0,", "home", "too far away"},
    {"ChargerOutsideMap", "charger: {x: 1.0,", "charger: {x: -4.0,", "charger", "charger lies outside the map", true},
    {"CameraTooHigh", "home: {x: 1.0, y: 1.0,", "scene_camera: {x: 1, y: 2, height: 80}\nhome: {x: 1.0, y: 1.0,",
     "scene_camera", "height must be 0.5 to 50 m"},
    {"CameraWithoutPlace", "home: {x: 1.0, y: 1.0,", "scene_camera: {height: 2.5}\nhome: {x: 1.0, y: 1.0,",
     "scene_camera", "missing key 'x'"},
    {"ExhibitInWall", "pose: {x: 7.5, y: 3.5,", "pose: {x: 6.1, y: 3.5,", "x: 6.1", "'coin' lies inside a wall", true},
    {"ExhibitInHazard", "pose: {x: 3.5, y: 2.0,", "pose: {x: 3.6, y: 3.4,", "x: 3.6, y: 3.4",
     "inside the hazard 'case'", true},
    {"ExhibitCloseToHazard", "pose: {x: 3.5, y: 2.0,", "pose: {x: 3.5, y: 2.8,", "y: 2.8", "from the hazard 'case'",
     true},
    {"ExhibitThatTheBodyWouldTouchAHazardAt", "pose: {x: 3.5, y: 2.0,", "pose: {x: 3.5, y: 2.6,", "y: 2.6",
     "only 0.4 m from the hazard 'case', the robot needs 0.565 m", true},
    {"ExhibitCloseToWall", "pose: {x: 7.5, y: 3.5,", "pose: {x: 6.4, y: 3.5,", "x: 6.4", "the robot needs 0.365 m",
     true},
    {"ExhibitOutsideArea", "pose: {x: 7.5, y: 3.5,", "pose: {x: 7.5, y: 7.7,", "y: 7.7", "outside the area", true},
    {"ExhibitUnreachable", "pose: {x: 7.5, y: 3.5,", "pose: {x: 7.5, y: 6.5,", "y: 6.5", "cannot be reached", true},
    {"ExhibitInTheUnknown", "pose: {x: 7.5, y: 3.5,", "pose: {x: 1.0, y: 7.0,", "y: 7.0", "map is unknown", true},
    {"ViewpointInHazard", "{x: 4.8, y: 3.6, heading: 180}", "{x: 3.9, y: 3.6, heading: 180}", "x: 3.9",
     "viewpoint 2 of exhibit 'clock' lies inside the hazard", true},
    {"ViewpointUnreachable", "{x: 4.8, y: 3.6, heading: 180}", "{x: 8.0, y: 6.6, heading: 180}", "x: 8.0",
     "viewpoint 2 of exhibit 'clock' cannot be reached", true},
    {"ViewpointIncomplete", "{x: 4.8, y: 3.6, heading: 180}", "{x: 4.8, y: 3.6}", "x: 4.8", "missing key 'heading'"},
    {"LooksFarAway", "look_at: {x: 8.5, y: 3.5}", "look_at: {x: 608.5, y: 3.5}", "look_at: {x: 608.5", "601 m away",
     true},
    {"LooksAtItself", "look_at: {x: 8.5, y: 3.5}", "look_at: {x: 7.5, y: 3.5}", "look_at: {x: 7.5", "where the robot"},
    {"ExhibitTwice", "id: coin", "id: clock", "id: clock\n    title: {en: \"The coin\"",
     "exhibit 'clock' stands twice"},
    {"BadId", "id: coin", "id: The Coin", "id: The Coin", "small letters"},
    {"NextUnknown", "topics: [time, metal]", "next: [coin, medal]", "next:", "unknown exhibit 'medal'"},
    {"NextItself", "topics: [time, metal]", "next: [clock]", "next:", "follows itself"},
    {"TopicsNoList", "topics: [time, metal]", "topics: time", "topics: time", "expected a list"},
    {"WebOnlyNoBool", "web_only: true", "web_only: perhaps", "web_only", "expected true or false"},
    {"UnknownMode", "  open: {", "  party: {", "party", "unknown mode 'party'"},
    {"SpeedZero", "max_speed: 0.6", "max_speed: 0", "open:", "max_speed must be > 0"},
    {"SpeedTooHigh", "max_speed: 0.6", "max_speed: 30", "open:", "at most 3 m/s"},
    {"WaitNegative", "wait_s: 30", "wait_s: -1", "web:", "wait_s must be 0..600 s"},
    {"WaitForHours", "wait_s: 30", "wait_s: 30000", "web:", "wait_s must be 0..600 s"},
    {"HoursBad", "20:00-22:00", "20:00-25:00", "web:", "expected HH:MM-HH:MM"},
    {"HoursEmpty", "20:00-22:00", "20:00-20:00", "web:", "are the same"},
    {"TourUnknownExhibit", "exhibits: [clock, coin]", "exhibits: [clock, sword]", "sword", "unknown exhibit 'sword'"},
    {"TourOfWebOnly", "exhibits: [clock, coin]", "exhibits: [clock, staff]", "{id: all", "is for the Web only"},
    {"TourRepeats", "exhibits: [clock, coin]", "exhibits: [clock, coin, clock]", "{id: all", "'clock' stands twice"},
    {"TourTwice", "id: quick", "id: all", "{id: all, title: {en: \"Quick\"", "tour 'all' stands twice"},
    {"TourWithoutContent", ", minutes: 6", "", "quick", "either exhibits or minutes"},
    {"TourWithBoth", ", minutes: 6", ", minutes: 6, exhibits: [coin]", "quick", "either exhibits or minutes"},
    {"DailyAtNoTime", ", minutes: 6", ", minutes: 6, daily: [2 pm]", "quick", "time '2 pm': expected HH:MM"},
    {"DailyTwice", ", minutes: 6", R"(, minutes: 6, daily: ["14:00", "14:00"])", "quick", "14:00 stands twice"},
    {"DailyWithAnotherTour", R"(exhibits: [clock, coin]}
  - {id: quick, title: {en: "Quick", de: "Schnell"}, minutes: 6)",
     R"(exhibits: [clock, coin], daily: ["14:00"]}
  - {id: quick, title: {en: "Quick", de: "Schnell"}, minutes: 6, daily: ["14:00"])",
     "quick", "tour 'all' begins at 14:00, too"},
    {"DailyInTheHoursOfTheWeb", ", minutes: 6", R"(, minutes: 6, daily: ["20:30"])", "quick", "say web at 20:30"},
    {"MinutesZero", "minutes: 6", "minutes: 0", "quick", "minutes must be > 0"},
    {"MinutesNoNumber", "minutes: 6", "minutes: some", "quick", "expected a number"},
    {"MusicMissing", "map: map.yaml", "map: map.yaml\nsound:\n  music: content/tune.ogg", "  music", "does not exist",
     true},
    {"MusicOutsideFolder", "map: map.yaml", "map: map.yaml\nsound: {music: ../tune.ogg}", "sound", "not a file inside"},
    {"QuietHoursBad", "map: map.yaml", "map: map.yaml\nsound: {quiet_hours: [noon]}", "sound", "expected HH:MM-HH:MM"},
    {"QuietVolumeTooHigh", "map: map.yaml", "map: map.yaml\nsound: {quiet_volume: 2}", "sound", "must be 0 to 1"},
    {"UnknownKeyInSound", "map: map.yaml", "map: map.yaml\nsound: {volume: 1}", "sound", "unknown key 'volume'"},
    {"SimulationMissing", "map: map.yaml", "map: map.yaml\nsimulation: world.yaml", "simulation", "does not exist",
     true},
};

class BrokenMuseum : public ::testing::TestWithParam<Broken> {};

TEST_P(BrokenMuseum, IsRefusedWithFileLineAndReason) {
  const Broken& broken = GetParam();
  const SmallMuseum museum;
  std::string text = kMuseum;
  const auto at = text.find(broken.from);
  ASSERT_NE(at, std::string::npos);
  text.replace(at, std::string{broken.from}.size(), broken.to);
  museum.write("museum.yaml", text);

  const auto faults = check_museum(museum.folder());
  ASSERT_FALSE(faults.empty());
  std::string all;
  bool found = false;
  for (const auto& fault : faults) {
    all += fault.message + "\n";
    EXPECT_EQ(fault.message.find('\n'), std::string::npos) << "one line a fault";
    if (fault.message.find(broken.why) == std::string::npos) continue;
    found = true;
    if (*broken.where == '\0') continue;
    const std::string place =
        (museum.folder() / "museum.yaml").string() + ":" + std::to_string(line_of(text, broken.where)) + ": ";
    EXPECT_EQ(fault.message.substr(0, place.size()), place);
  }
  EXPECT_TRUE(found) << "expected: " << broken.why << "\nfound:\n" << all;
  const auto loaded = load_museum(museum.folder());
  EXPECT_EQ(loaded.has_value(), broken.only_check);
}

INSTANTIATE_TEST_SUITE_P(Museum, BrokenMuseum, ::testing::ValuesIn(kBroken),
                         [](const auto& instance) { return std::string{instance.param.name}; });

TEST(Museum, SmallOneIsFine) {
  const SmallMuseum small;
  for (const auto& fault : check_museum(small.folder())) ADD_FAILURE() << fault.message;
  const auto museum = load_museum(small.folder());
  ASSERT_TRUE(museum) << museum.error().message;
  EXPECT_EQ(museum->name.at("de"), "Kleines Museum");
  EXPECT_EQ(museum->exhibits[0].short_text.at("en"), "This is clock.en.\n");
  EXPECT_EQ(museum->exhibits[0].viewpoints.size(), 2U);
  EXPECT_EQ(museum->exhibits[1].long_text.at("de"), "This is coin.long.de.\n");
  EXPECT_NEAR(museum->exhibits[0].pose.theta.degrees(), 90.0, 1e-9);
  EXPECT_DOUBLE_EQ(museum->modes.at("open").max_speed, 0.6);
  EXPECT_DOUBLE_EQ(museum->modes.at("closed").max_speed, 1.63) << "what the file leaves out keeps its default";
  EXPECT_EQ(museum->hazards[1].kind, HazardKind::stairs);
  ASSERT_EQ(museum->hazard_polygons().size(), museum->hazards.size());
  EXPECT_EQ(museum->hazard_polygons()[1], museum->hazards[1].polygon);
  EXPECT_EQ(museum->tours[1].minutes, 6.0);
  EXPECT_EQ(museum->find_exhibit("coin")->title.at("de"), "Die Münze");
  EXPECT_EQ(museum->find_exhibit("sword"), nullptr);
  EXPECT_EQ(museum->find_tour("all")->exhibits.size(), 2U);
}

TEST(Museum, AnExhibitMayHaveAPicture) {
  const SmallMuseum small;
  std::string text = kMuseum;
  const std::string topics = "topics: [time, metal]";
  text.insert(text.find(topics), "picture: content/clock.svg\n    ");
  small.write("museum.yaml", text);
  small.write("content/clock.svg", "<svg xmlns='http://www.w3.org/2000/svg'/>");
  for (const auto& fault : check_museum(small.folder())) ADD_FAILURE() << fault.message;
  const auto museum = load_museum(small.folder());
  ASSERT_TRUE(museum) << museum.error().message;
  EXPECT_EQ(museum->exhibits[0].picture, "content/clock.svg");
  EXPECT_EQ(museum->exhibits[1].picture, "");
}

TEST(Museum, FaultsOfOtherFilesAreNamed) {
  const SmallMuseum small;
  const auto expect = [&](const std::string& part) {
    const auto faults = check_museum(small.folder());
    ASSERT_EQ(faults.size(), 1U) << part;
    EXPECT_NE(faults[0].message.find(part), std::string::npos) << faults[0].message;
    EXPECT_FALSE(load_museum(small.folder()));
  };
  small.write("content/coin.de.md", " \n");
  expect("content/coin.de.md is empty");
  small.write("content/coin.de.md", "M\xfcnze");
  expect("content/coin.de.md is not valid UTF-8");
  small.write("content/coin.de.md", std::string(20'000, 'a'));
  expect("content/coin.de.md is longer");
  small.write("content/coin.de.md", "Münze");
  small.write("map.pgm", "P5\n3 3\n255\nab");
  expect("map.pgm");
  std::filesystem::remove(small.folder() / "map.pgm");
  expect("map.yaml:1: image");
  std::filesystem::remove(small.folder() / "museum.yaml");
  expect("museum.yaml: cannot be read");
}

TEST(Museum, AMisspeltFolderIsToldFromTheMuseumsBesideIt) {
  const SmallMuseum small;
  const std::filesystem::path folder = small.folder().parent_path();
  const std::string name = small.folder().filename().string();
  const auto fault = load_museum(folder / (name + "e"));
  ASSERT_FALSE(fault);
  const std::string& message = fault.error().message;
  EXPECT_TRUE(message.starts_with((folder / (name + "e")).string() + ": there is no such folder; did you mean '"))
      << message;
  EXPECT_NE(message.find("(museums in " + folder.string() + ": "), std::string::npos) << message;
  EXPECT_NE(message.find(name), std::string::npos) << message;
  EXPECT_EQ(check_museum(folder / (name + "e")).at(0).message, message);

  const auto nowhere = load_museum("/nowhere/hall");
  ASSERT_FALSE(nowhere);
  EXPECT_TRUE(nowhere.error().message.starts_with("/nowhere/hall: there is no such folder (museums in "));
  EXPECT_NE(load_museum("/nowhere/bonn").error().message.find("/museums/bonn'?"), std::string::npos)
      << "its whole path";
  EXPECT_NE(nowhere.error().message.find("bonn, smithsonian"), std::string::npos) << "those that come with the program";
}

TEST(Museum, EveryFaultIsNamedNotOnlyTheFirst) {
  const SmallMuseum small;
  std::string text = kMuseum;
  const auto change = [&](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  change("kind: stairs", "kind: lava");
  change("pose: {x: 7.5, y: 3.5,", "pose: {x: 7.5, y: 6.5,");
  change("max_speed: 0.6", "max_speed: -1");
  change("minutes: 6", "minutes: 0");
  small.write("museum.yaml", text);
  EXPECT_EQ(check_museum(small.folder()).size(), 4U);
}

TEST(Museum, SensibleNextGoesByTopicOrByList) {
  const SmallMuseum small;
  auto museum = load_museum(small.folder()).value();
  ASSERT_EQ(sensible_next(museum, museum.exhibits[0]).size(), 1U) << "both are of metal; the staff is for the Web";
  EXPECT_EQ(sensible_next(museum, museum.exhibits[0])[0]->id, "coin");
  EXPECT_EQ(sensible_pairs(museum), 2U);
  museum.exhibits[0].topics = {"time"};
  EXPECT_EQ(sensible_pairs(museum), 0U);
  museum.exhibits[0].next = {"coin"};
  EXPECT_EQ(sensible_pairs(museum), 1U) << "a list counts in one direction";
}

TEST(Hours, RunPastMidnight) {
  const auto evening = parse_hours("20:00-22:00").value();
  EXPECT_TRUE(evening.holds(20 * 60));
  EXPECT_FALSE(evening.holds(22 * 60));
  const auto night = parse_hours("22:30-02:00").value();
  EXPECT_TRUE(night.holds(23 * 60));
  EXPECT_TRUE(night.holds(60));
  EXPECT_FALSE(night.holds(12 * 60));
  EXPECT_EQ(parse_hours("08:00-24:00").value().to_minute, 1440);
  for (const char* bad : {"", "8:00-9:00", "08:00-24:01", "24:00-08:00", "08:60-09:00", "ab:cd-ef:gh", "08:00 09:00"}) {
    EXPECT_FALSE(parse_hours(bad)) << bad;
  }
}

TEST(Museum, IsQuietInItsQuietHours) {
  const SmallMuseum small;
  small.write("content/tune.ogg", "any");
  small.write("museum.yaml", std::string{kMuseum} +
                                 "\nsound: {music: content/tune.ogg, quiet_hours: [\"22:00-08:00\", "
                                 "\"12:30-13:00\"], quiet_volume: 0.2}\n");
  const auto museum = load_museum(small.folder());
  ASSERT_TRUE(museum) << museum.error().message;
  EXPECT_EQ(museum->sound.music, small.folder() / "content/tune.ogg");
  for (const int quiet : {23 * 60, 0, 7 * 60 + 59, 12 * 60 + 30}) EXPECT_EQ(volume_at(*museum, quiet), 0.2) << quiet;
  for (const int usual : {8 * 60, 12 * 60, 13 * 60, 21 * 60}) EXPECT_EQ(volume_at(*museum, usual), 1.0) << usual;
  EXPECT_EQ(volume_at(Museum{}, 0), 1.0) << "no hours are quiet unless the museum says so";
}

TEST(Translations, FallBackToTheFirst) {
  EXPECT_EQ(translated({{"de", "ja"}, {"en", "yes"}}, "en"), "yes");
  EXPECT_EQ(translated({{"de", "ja"}, {"en", "yes"}}, "fr"), "ja");
  EXPECT_EQ(translated({}, "fr"), "");
}

TEST(Bonn, IsFine) {
  for (const auto& fault : check_museum("museums/bonn")) ADD_FAILURE() << fault.message;
  const auto museum = load_museum("museums/bonn");
  ASSERT_TRUE(museum) << museum.error().message;
  EXPECT_EQ(museum->exhibits.size(), 14U) << "thirteen and the crew";
  std::size_t viewpoints = 0;
  std::size_t with_viewpoints = 0;
  for (const auto& exhibit : museum->exhibits) {
    viewpoints += exhibit.viewpoints.size();
    if (!exhibit.viewpoints.empty()) ++with_viewpoints;
    EXPECT_LE(exhibit.viewpoints.size(), 12U);
  }
  EXPECT_EQ(viewpoints, 36U);
  EXPECT_EQ(with_viewpoints, 4U);
  EXPECT_TRUE(museum->find_exhibit("crew")->web_only);
}

TEST(Smithsonian, IsFine) {
  for (const auto& fault : check_museum("museums/smithsonian")) ADD_FAILURE() << fault.message;
  const auto museum = load_museum("museums/smithsonian");
  ASSERT_TRUE(museum) << museum.error().message;
  EXPECT_EQ(museum->exhibits.size(), 23U);
  EXPECT_EQ(sensible_pairs(*museum), 77U);
  EXPECT_TRUE(museum->charger);
}

}  // namespace
}  // namespace docent::museum
