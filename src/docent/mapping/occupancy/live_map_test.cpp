#include "docent/mapping/occupancy/live_map.h"

#include <gtest/gtest.h>

namespace docent {
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

}  // namespace
}  // namespace docent
