#include "docent/mapping/occupancy/live_map.h"

#include <gtest/gtest.h>

namespace docent::mapping::live_map_test {
namespace {

OccupancyGrid hall() {
  OccupancyGrid map;
  map.frame = {100, 100, 0.05, {0, 0}};
  map.cells.assign(map.frame.size(), 0);
  for (int i = 0; i < 100; ++i) map.cells[map.frame.index({99, i})] = 100;
  return map;
}

bool blocked(const LiveMap& map, Point2 point) { return map.is_blocked(map.frame().index(map.frame().cell_at(point))); }

TEST(LiveMap, WhoStandsBlocksAndWhoWalksDoesNot) {
  LiveMap map{hall(), {}};
  const std::vector<Point2> stands{{3.0, 2.5}};
  for (int i = 0; i < 2; ++i) map.look({1, 2.5}, stands, time_from_seconds(i));
  EXPECT_FALSE(blocked(map, {3.0, 2.5}));
  map.look({1, 2.5}, stands, time_from_seconds(2));
  EXPECT_TRUE(blocked(map, {3.0, 2.5}));
  ASSERT_TRUE(map.take_changes().has_value());
  EXPECT_FALSE(map.take_changes().has_value());
  const std::vector<Point2> gone{{4.9, 2.5}};
  for (int i = 3; i < 5; ++i) map.look({1, 2.5}, gone, time_from_seconds(i));
  EXPECT_FALSE(blocked(map, {3.0, 2.5}));
  EXPECT_TRUE(map.take_changes().has_value());
}

TEST(LiveMap, WhereANearSightedScannerMetNothingNothingStands) {
  const std::vector<Point2> nothing{{4.0, 2.5}};
  LiveMap map{hall(), {}};
  for (int i = 0; i < 4; ++i) map.look({1, 2.5}, nothing, time_from_seconds(i), 3.0);
  EXPECT_FALSE(blocked(map, {4.0, 2.5}));
  for (int i = 4; i < 8; ++i) map.look({1, 2.5}, nothing, time_from_seconds(i), 10.0);
  EXPECT_TRUE(blocked(map, {4.0, 2.5})) << "one that looks farther met something";
  for (int i = 8; i < 12; ++i) map.look({1, 2.5}, std::vector<Point2>{{4.5, 2.5}}, time_from_seconds(i), 3.5);
  EXPECT_FALSE(blocked(map, {4.0, 2.5})) << "rays that met nothing clear";
}

TEST(LiveMap, TheMappedWallIsNoNews) {
  LiveMap map{hall(), {}};
  for (int i = 0; i < 8; ++i) map.look({1, 2.5}, std::vector<Point2>{{4.9, 2.5}}, time_from_seconds(i));
  EXPECT_FALSE(blocked(map, {4.9, 2.5}));
}

TEST(LiveMap, ForgetsWhatNobodyLooksAt) {
  LiveMap map{hall(), {}};
  for (int i = 0; i < 4; ++i) map.look({1, 2.5}, std::vector<Point2>{{3.0, 2.5}}, time_from_seconds(i));
  map.forget(time_from_seconds(20));
  EXPECT_TRUE(blocked(map, {3.0, 2.5}));
  map.forget(time_from_seconds(40));
  EXPECT_FALSE(blocked(map, {3.0, 2.5}));
}

TEST(LiveMap, RemembersForMinutesWhatStoodForLong) {
  LiveMap map{hall(), {}};
  const auto index = map.frame().index(map.frame().cell_at({3.0, 2.5}));
  for (int i = 0; i < 20; ++i) map.look({1, 2.5}, std::vector<Point2>{{3.0, 2.5}}, time_from_seconds(i));
  EXPECT_EQ(map.cell(index), LiveMap::kPassing);
  (void)map.take_changes();
  for (int i = 20; i < 30; ++i) map.look({1, 2.5}, std::vector<Point2>{{3.0, 2.5}}, time_from_seconds(i));
  EXPECT_EQ(map.cell(index), LiveMap::kSettled);
  EXPECT_TRUE(map.take_changes().has_value()) << "the planner must know";
  map.forget(time_from_seconds(300));
  EXPECT_EQ(map.cell(index), LiveMap::kSettled);
  map.forget(time_from_seconds(335));
  EXPECT_EQ(map.cell(index), 0);
}

TEST(LiveMap, FreesWhatWasSettledAsSoonAsItIsSeenFree) {
  LiveMap map{hall(), {}};
  for (int i = 0; i < 40; ++i) map.look({1, 2.5}, std::vector<Point2>{{3.0, 2.5}}, time_from_seconds(i));
  for (int i = 100; i < 102; ++i) map.look({1, 2.5}, std::vector<Point2>{{4.9, 2.5}}, time_from_seconds(i));
  EXPECT_FALSE(blocked(map, {3.0, 2.5}));
  for (int i = 110; i < 113; ++i) map.look({1, 2.5}, std::vector<Point2>{{3.0, 2.5}}, time_from_seconds(i));
  EXPECT_EQ(map.cell(map.frame().index(map.frame().cell_at({3.0, 2.5}))), LiveMap::kPassing) << "it counts anew";
}

/// One sonar looks at what stands at (3.0, 2.5), and a laser looks over it.
void hear(LiveMap& map, double range, double now) {
  const std::vector<Point2> wall{{4.9, 2.5}};
  const LaserLook laser{{1.0, 2.5, {}}, -1.6, 3.2, wall};
  map.add_sonar({{1.8, 2.5, {}}, 0.26, 5.0, range}, {&laser, 1}, time_from_seconds(now));
}

TEST(LiveMap, ALaserThatLooksOverAThingDoesNotFreeIt) {
  LiveMap map{hall(), {}};
  const auto index = map.frame().index(map.frame().cell_at({3.0, 2.5}));
  for (int i = 0; i < 6; ++i) hear(map, 1.2, 0.4 * i);
  EXPECT_EQ(map.cell(index), LiveMap::kSettled);
  EXPECT_TRUE(map.take_changes().has_value()) << "the planner must know";
  for (int i = 10; i < 40; ++i) map.look({1, 2.5}, std::vector<Point2>{{4.9, 2.5}}, time_from_seconds(i));
  EXPECT_EQ(map.cell(index), LiveMap::kSettled);
  for (int i = 0; i < 10; ++i) hear(map, 5.0, 40.0 + 0.4 * i);
  EXPECT_EQ(map.cell(index), 0);
  EXPECT_TRUE(map.take_changes().has_value());
}

TEST(LiveMap, ASonarThatHearsNothingDoesNotFreeWhatALaserSees) {
  LiveMap map{hall(), {}};
  for (int i = 0; i < 4; ++i) map.look({1, 2.5}, std::vector<Point2>{{3.0, 2.5}}, time_from_seconds(i));
  for (int i = 0; i < 20; ++i) hear(map, 5.0, 4.0 + 0.4 * i);
  EXPECT_TRUE(blocked(map, {3.0, 2.5}));
}

TEST(LiveMap, EveryLayerCountsByTheMaxRule) {
  LiveMap map{hall(), {}};
  const auto index = map.frame().index(map.frame().cell_at({3.0, 2.5}));
  for (int i = 0; i < 4; ++i) map.look({1, 2.5}, std::vector<Point2>{{3.0, 2.5}}, time_from_seconds(i));
  EXPECT_EQ(map.cell(index), LiveMap::kPassing) << "somebody";
  map.add_infrared({{2.4, 2.5, {}}, 0.09, 0.8, 0.6}, {}, time_from_seconds(4));
  EXPECT_EQ(map.cell(index), LiveMap::kPassing) << "once is not enough";
  for (int i = 0; i < 6; ++i) hear(map, 1.2, 4.0 + 0.4 * i);
  EXPECT_EQ(map.cell(index), LiveMap::kSettled);
  for (int i = 0; i < 10; ++i) hear(map, 5.0, 8.0 + 0.4 * i);
  EXPECT_EQ(map.cell(index), LiveMap::kPassing) << "the thing is gone, somebody is still there";
  const auto wall = map.frame().index(map.frame().cell_at({4.97, 2.5}));
  EXPECT_EQ(map.cell(wall), OccupancyGrid::kOccupied);
}

TEST(LiveMap, WhatASonarSeesGoneIsGoneForTheInfraredSensorsToo) {
  LiveMap map{hall(), {}};
  const auto look_near = [&map](double at_s) {
    for (int i = 0; i < 6; ++i)
      map.add_infrared({{2.4, 2.5, {}}, 0.09, 0.8, 0.6}, {}, time_from_seconds(at_s + 0.2 * i));
  };
  look_near(0.0);
  for (int i = 0; i < 10; ++i) hear(map, 5.0, 2.0 + 0.4 * i);
  EXPECT_TRUE(blocked(map, {3.0, 2.5})) << "the sonar never met it: it may be lower than the sonars";
  for (int i = 0; i < 6; ++i) hear(map, 1.2, 8.0 + 0.4 * i);
  look_near(11.0);
  for (int i = 0; i < 10; ++i) hear(map, 5.0, 14.0 + 0.4 * i);
  EXPECT_FALSE(blocked(map, {3.0, 2.5}));
}

TEST(LiveMap, WhatTouchesAndALaserSeesIsNoThing) {
  LiveMap map{hall(), {}};
  const std::vector<Point2> person{{2.4, 2.6}};
  const LaserLook sees{{2.0, 2.5, {}}, -1.6, 3.2, person};
  map.add_touch({2.265, 2.5}, {1.0, 0.0}, {&sees, 1}, time_from_seconds(1));
  EXPECT_FALSE(blocked(map, {2.6, 2.5}));
  map.add_touch({2.265, 2.5}, {1.0, 0.0}, {}, time_from_seconds(2));
  EXPECT_TRUE(blocked(map, {2.6, 2.5}));
  for (int i = 3; i < 40; ++i) map.look({1, 2.5}, std::vector<Point2>{{4.9, 2.5}}, time_from_seconds(i));
  EXPECT_TRUE(blocked(map, {2.6, 2.5})) << "lasers look over it";
}

TEST(LiveMap, NearHazardsAnEchoIsNoNews) {
  const std::vector<Polygon> glass{{{2.9, 2.0}, {3.2, 2.0}, {3.2, 3.0}, {2.9, 3.0}}};
  LiveMap map{hall(), {}, glass};
  for (int i = 0; i < 10; ++i) hear(map, 1.1, 0.4 * i);
  EXPECT_FALSE(map.take_changes().has_value());
}

}  // namespace
}  // namespace docent::mapping::live_map_test
