#include "docent/planning/navigator/live_obstacles.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace docent::planning::live_obstacles_test {
namespace {

constexpr std::int8_t kPassing = 80;  // blocked, but not for long

/// 6 x 4 cells, of which the lowest row is a wall.
OccupancyGrid walled() {
  OccupancyGrid map;
  map.frame = {6, 4, 0.15, {0.0, 0.0}};
  map.cells.assign(map.frame.size(), OccupancyGrid::kFree);
  std::fill_n(map.cells.begin(), 6, OccupancyGrid::kOccupied);
  return map;
}

class LiveObstaclesTest : public ::testing::Test {
 protected:
  /// Every second has a whole map; this one is free.
  void say_whole(double stamp) { live_.take_map(time_from_seconds(stamp), std::vector<std::int8_t>(24, 0)); }
  /// One cell, passing or settled.
  void say_cell(CellIndex cell, std::uint32_t number, double base, std::int8_t live = kPassing) {
    const std::vector<std::int8_t> cells{live};
    live_.take_patch({time_from_seconds(base), number, cell, 1, 1, cells});
  }
  [[nodiscard]] bool stands(CellIndex cell) const { return live_.standing()[walled().frame.index(cell)]; }
  [[nodiscard]] bool is_settled(CellIndex cell) const { return live_.settled()[walled().frame.index(cell)]; }

  LiveObstacles live_{walled()};
};

TEST_F(LiveObstaclesTest, AreWhatTheMapDoesNotShow) {
  std::vector<std::int8_t> cells(24, OccupancyGrid::kOccupied);
  cells[13] = kPassing;
  cells[14] = 64;
  cells[15] = OccupancyGrid::kUnknown;
  live_.take_map(time_from_seconds(1.0), cells);
  EXPECT_FALSE(stands({2, 0})) << "a wall";
  EXPECT_TRUE(stands({2, 1}));
  EXPECT_TRUE(is_settled({2, 1}));
  EXPECT_TRUE(stands({1, 2}));
  EXPECT_FALSE(is_settled({1, 2})) << "somebody who may walk on";
  EXPECT_FALSE(stands({2, 2}));
  EXPECT_FALSE(stands({3, 2}));
}

TEST_F(LiveObstaclesTest, AMapOfAnotherBuildingIsLeftOut) {
  live_.take_map(time_from_seconds(1.0), std::vector<std::int8_t>(23, OccupancyGrid::kOccupied));
  EXPECT_FALSE(stands({2, 2}));
  EXPECT_FALSE(live_.take_changes().has_value());
}

TEST_F(LiveObstaclesTest, RectanglesCountInTheirOrderAlone) {
  say_whole(1.0);
  say_cell({1, 1}, 2, 1.0);
  EXPECT_FALSE(stands({1, 1})) << "the first was lost";
  say_cell({1, 1}, 1, 0.5);
  EXPECT_FALSE(stands({1, 1})) << "of an older map";
  say_cell({1, 1}, 1, 1.0);
  EXPECT_TRUE(stands({1, 1}));
  say_cell({2, 1}, 1, 1.0);
  EXPECT_FALSE(stands({2, 1})) << "heard already";
  say_cell({2, 1}, 3, 1.0);
  EXPECT_FALSE(stands({2, 1})) << "a gap";
  say_cell({2, 1}, 2, 1.0);
  EXPECT_TRUE(stands({2, 1}));
  say_whole(2.0);
  EXPECT_FALSE(stands({1, 1}));
  say_cell({3, 1}, 1, 2.0);
  EXPECT_TRUE(stands({3, 1})) << "the whole map counts from there on";
}

TEST_F(LiveObstaclesTest, AnEmptyRectangleKeepsTheOrderAndAFaultyOneDoesNot) {
  say_whole(1.0);
  live_.take_patch({time_from_seconds(1.0), 1, {0, 0}, 0, 0, {}});
  say_cell({1, 1}, 2, 1.0);
  EXPECT_TRUE(stands({1, 1}));
  const std::vector<std::int8_t> short_of_one(3, kPassing);
  live_.take_patch({time_from_seconds(1.0), 3, {2, 2}, 2, 2, short_of_one});
  EXPECT_FALSE(stands({2, 2}));
  say_cell({2, 2}, 3, 1.0);
  EXPECT_TRUE(stands({2, 2}));
}

TEST_F(LiveObstaclesTest, WhatStandsNearAPlaceIsFound) {
  say_whole(1.0);
  say_cell({3, 2}, 1, 1.0);  // its middle lies at (0.525, 0.375)
  EXPECT_TRUE(live_.stands_within({0.4, 0.4}, 0.2));
  EXPECT_FALSE(live_.stands_within({0.2, 0.4}, 0.2));
  EXPECT_FALSE(live_.stands_within({0.3, 0.07}, 0.1)) << "a wall of the map is no news";
  EXPECT_FALSE(live_.stands_within({-50.0, 9.0}, 0.3));
}

TEST_F(LiveObstaclesTest, TellsOnceWhereTheyMayHaveChanged) {
  EXPECT_FALSE(live_.take_changes().has_value());
  say_whole(1.0);
  auto box = live_.take_changes();
  ASSERT_TRUE(box.has_value());
  EXPECT_EQ(box->low, (CellIndex{0, 0}));
  EXPECT_EQ(box->high, (CellIndex{5, 3}));
  EXPECT_FALSE(live_.take_changes().has_value());
  say_cell({1, 2}, 1, 1.0);
  const std::vector<std::int8_t> beyond(4, kPassing);
  live_.take_patch({time_from_seconds(1.0), 2, {3, 3}, 2, 2, beyond});  // a row of it lies outside
  box = live_.take_changes();
  ASSERT_TRUE(box.has_value());
  EXPECT_EQ(box->low, (CellIndex{1, 2}));
  EXPECT_EQ(box->high, (CellIndex{4, 3}));
  EXPECT_TRUE(stands({3, 3}));
  EXPECT_TRUE(stands({4, 3}));
}

}  // namespace
}  // namespace docent::planning::live_obstacles_test
