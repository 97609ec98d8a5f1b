#include "docent/simulator/world/world.h"

#include <gtest/gtest.h>

namespace docent::simulator {
namespace {

const char* const kFrame = R"(
floor: [[0, 0], [10, 0], [10, 8], [0, 8]]
operating_area: [[1, 1], [9, 1], [9, 7], [1, 7]]
entrances: [[0.5, 0.5]]
home: {x: 5, y: 4}
)";

std::string with_solid(const std::string& solid) { return std::string{kFrame} + "solids:\n  - " + solid + "\n"; }

TEST(World, ReadsEachWayToWriteAnOutline) {
  const auto world = parse_world(std::string{kFrame} + R"(solids:
  - {id: a, kind: furniture, polygon: [[1, 1], [2, 1], [2, 2]]}
  - {id: b, kind: wall, thickness: 0.2, line: [[0, 0], [10, 0], [10, 8]]}
  - {id: c, kind: glass, box: {x: 5, y: 5, length: 2, width: 1, heading: 90}}
  - {id: d, kind: plate, circle: {x: 3, y: 3, radius: 0.5}}
  - {id: e, kind: stairs, polygon: [[8, 6], [9, 6], [9, 7]]}
)",
                                 "w.yaml");
  ASSERT_TRUE(world) << world.error().message;
  ASSERT_EQ(world->solids.size(), 6U);
  EXPECT_EQ(world->solids[1].id, "b-1");
  EXPECT_EQ(world->solids[2].id, "b-2");
  EXPECT_NEAR(signed_area(world->solids[1].polygon), 10.2 * 0.2, 1e-9);
  EXPECT_NEAR(distance(world->solids[2].polygon, {10.0, -0.1}), 0.0, 1e-9) << "the corner is closed";
  EXPECT_TRUE(contains(world->solids[3].polygon, {5.4, 5.9}));
  EXPECT_FALSE(contains(world->solids[3].polygon, {5.9, 5.4}));
  EXPECT_NEAR(distance(world->solids[4].polygon, {4.0, 3.0}), 0.5, 1e-9);
  EXPECT_EQ(world->solids[5].kind, SolidKind::stairs);
}

TEST(World, LasersSeeWhatReachesTheirHeight) {
  const auto seen = [](SolidKind kind, double bottom, double top) {
    return is_seen_by_laser({"s", kind, {}, bottom, top, false});
  };
  EXPECT_TRUE(seen(SolidKind::wall, 0.0, 3.0));
  EXPECT_TRUE(seen(SolidKind::furniture, 0.3, 1.5));
  EXPECT_FALSE(seen(SolidKind::furniture, 0.0, 0.3)) << "a low podium";
  EXPECT_FALSE(seen(SolidKind::furniture, 0.7, 0.75)) << "a table top";
  EXPECT_FALSE(seen(SolidKind::glass, 0.0, 2.0));
  EXPECT_FALSE(seen(SolidKind::plate, 0.0, 1.0));
  EXPECT_FALSE(seen(SolidKind::stairs, 0.0, 1.0));
}

TEST(World, CeilingHasPartsAndWallsReachIt) {
  const auto world = parse_world(std::string{kFrame} + R"(ceiling_height: 3.2
ceiling: [{polygon: [[4, 0], [10, 0], [10, 8], [4, 8]], height: 9}]
solids:
  - {id: low, kind: wall, line: [[1, 1], [3, 1]]}
  - {id: high, kind: wall, line: [[1, 5], [8, 5]]}
)",
                                 "w.yaml");
  ASSERT_TRUE(world) << world.error().message;
  EXPECT_DOUBLE_EQ(world->ceiling_at({2.0, 2.0}), 3.2);
  EXPECT_DOUBLE_EQ(world->ceiling_at({7.0, 2.0}), 9.0);
  EXPECT_DOUBLE_EQ(world->solids[0].top, 3.2);
  EXPECT_DOUBLE_EQ(world->solids[1].top, 9.0);
}

TEST(World, HasAStyleOfCeilingMarksAndSmallThings) {
  const auto world = parse_world(std::string{kFrame} + R"(ceiling_style: {kind: periodic, seed: 7}
marks: [{id: charger, tag: 3, x: 1, y: 2, height: 0.4, heading: 90, tilt: -30, size: 0.1}]
solids:
  - {id: can-1, kind: can, circle: {x: 3, y: 3, radius: 0.033}}
  - {id: wad-1, kind: wad, circle: {x: 4, y: 3, radius: 0.04}}
  - {id: bin-1, kind: bin, circle: {x: 5, y: 3, radius: 0.15}}
)",
                                 "w.yaml");
  ASSERT_TRUE(world) << world.error().message;
  EXPECT_EQ(world->ceiling_style.kind, CeilingKind::periodic);
  EXPECT_EQ(world->ceiling_style.seed, 7U);
  ASSERT_EQ(world->marks.size(), 1U);
  EXPECT_EQ(world->marks[0].tag, 3);
  EXPECT_NEAR(world->marks[0].heading.degrees(), 90.0, 1e-9);
  EXPECT_NEAR(world->marks[0].tilt, -0.5236, 1e-4);
  ASSERT_EQ(world->solids.size(), 3U);
  EXPECT_EQ(world->solids[0].form, SolidForm::can);
  EXPECT_EQ(world->solids[0].kind, SolidKind::furniture);
  EXPECT_DOUBLE_EQ(world->solids[0].top, 0.12);
  EXPECT_TRUE(is_litter(world->solids[1]));
  EXPECT_FALSE(is_litter(world->solids[2]));
  EXPECT_STREQ(kind_name(world->solids[2]), "bin");
}

TEST(World, FaultsNameFileAndLine) {
  struct Case {
    std::string text;
    std::string expected;
  };
  const std::vector<Case> cases{
      {with_solid("{id: a, kind: fog, circle: {x: 1, y: 1, radius: 1}}"), "w.yaml:7: unknown kind 'fog'"},
      {with_solid("{id: a, kind: wall}"), "w.yaml:7: needs exactly one of polygon, line, box, circle"},
      {with_solid("{id: a, kind: wall, line: [[1, 1]]}"), "w.yaml:7: a line needs at least 2 points"},
      {with_solid("{id: a, kind: wall, line: [[1, 1], [1, 1]]}"), "w.yaml:7: two points"},
      {with_solid("{id: a, kind: wall, line: [[1, 1], [2, 2]], thickness: 0}"), "w.yaml:7: thickness"},
      {with_solid("{id: a, kind: wall, polygon: [[1, 1], [2, 2]]}"), "w.yaml:7: a polygon needs at least 3"},
      {with_solid("{id: a, kind: wall, polygon: [[0, 0], [2, 2], [2, 0], [0, 2]]}"), "w.yaml:7: the polygon crosses"},
      {with_solid("{id: a, kind: wall, polygon: [[0, 0], [2, 2], [3]]}"), "w.yaml:7: expected corners"},
      {with_solid("{id: a, kind: wall, box: {x: 1, y: 1, length: -1, width: 1}}"), "w.yaml:7: length and width"},
      {with_solid("{id: a, kind: wall, circle: {x: 1, y: 1, radius: 0}}"), "w.yaml:7: radius"},
      {with_solid("{id: a, kind: furniture, top: 0, circle: {x: 1, y: 1, radius: 1}}"), "w.yaml:7: top must"},
      {with_solid("{id: a, kind: wall, colour: red, circle: {x: 1, y: 1, radius: 1}}"), "w.yaml:7: unknown key"},
      {with_solid("{id: a, kind: wall, line: [[1, 1], [2, 1]]}\n  - {id: a, kind: wall, line: [[1, 2], [2, 2]]}"),
       "w.yaml:8: solid 'a' stands twice"},
      {std::string{kFrame} + "solids: []\nvisitors_per_hour: -1\n", "w.yaml:7: must be >= 0"},
      {std::string{kFrame} + "solids: []\nattractions: [{id: a, centre: {x: 1, y: 1}, radius: 0}]\n",
       "w.yaml:7: radius"},
      {std::string{kFrame} + "solids: []\nceiling_style: {kind: gothic}\n", "w.yaml:7: unknown kind 'gothic'"},
      {std::string{kFrame} + "solids: []\nmarks: [{id: a, tag: 587, x: 1, y: 1, height: 1}]\n", "w.yaml:7: tag must"},
      {std::string{kFrame} + "solids: []\nmarks: [{id: a, tag: 1, x: 1, y: 1, height: 1, size: 0}]\n",
       "w.yaml:7: size must"},
      {std::string{kFrame} + "solids: []\nmarks: [{id: a, tag: 1, x: 1, y: 1, height: 1, tilt: 91}]\n",
       "w.yaml:7: tilt must"},
      {kFrame, "w.yaml:2: missing key 'solids'"},
      {"floor: 3\n", "w.yaml:1: expected a list"},
      {"floor: [[0, 0], [1, 0], [1, 1]]\noperating_area: [[0, 0], [1, 0], [1, 1]]\nsolids: []\nentrances: []\n"
       "home: {x: 0.9, y: 0.5}\n",
       "w.yaml:4: no entrance"},
      {"floor: [[0, 0], [1, 0], [1, 1]]\noperating_area: [[0, 0], [1, 0], [1, 1]]\nsolids: []\n"
       "entrances: [[0.9, 0.5]]\nhome: {x: 3, y: 0.5}\n",
       "w.yaml:5: home lies outside"},
      {"floor: [[0, 0\n", "not valid YAML"},
  };
  for (const auto& [text, expected] : cases) {
    const auto world = parse_world(text, "w.yaml");
    ASSERT_FALSE(world) << expected;
    EXPECT_NE(world.error().message.find(expected), std::string::npos) << world.error().message;
  }
}

}  // namespace
}  // namespace docent::simulator
