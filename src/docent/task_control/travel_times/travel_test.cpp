#include "docent/task_control/travel_times/travel.h"

#include <gtest/gtest.h>

#include <cmath>

namespace docent::task_control {
namespace {

/// 12 x 6 m of free floor with a wall across at x = 6 that leaves a gap of 1.5 m at the top.
OccupancyGrid hall_with_a_wall(bool has_gap) {
  OccupancyGrid map;
  map.frame = {120, 60, 0.1, {0, 0}};
  map.cells.assign(map.frame.size(), OccupancyGrid::kFree);
  for (int row = 0; row < 60; ++row) {
    for (int column = 0; column < 120; ++column) {
      const bool is_border = row == 0 || column == 0 || row == 59 || column == 119;
      const bool is_wall = column == 60 && (row < 45 || !has_gap);
      if (is_border || is_wall) map.cells[map.frame.index({column, row})] = OccupancyGrid::kOccupied;
    }
  }
  return map;
}

planning::RouteParams plain() {
  planning::RouteParams params;
  params.coarsening = 1;
  params.comfort_cost = 0.0;
  return params;
}

TEST(Travel, GoesRoundTheWall) {
  const auto travel = travel_on_map(planning::RoutePlanner{hall_with_a_wall(true), {}, {}, plain()});
  EXPECT_NEAR(travel({2, 2}, {5, 2}), 3.0, 0.4);
  const double round = travel({5, 1}, {7, 1});
  EXPECT_GT(round, 2.0 * std::hypot(1.0, 3.5) - 0.5);
  EXPECT_LT(round, 2.0 * (3.9 + 0.42) + 0.4) << "in steps of eight directions";
  EXPECT_NEAR(round, travel({7, 1}, {5, 1}), 0.3) << "the same way back";
  EXPECT_EQ(travel({5, 1}, {7, 1}), round) << "the kept field gives the same";
}

TEST(Travel, NoWayIsInfinite) {
  const auto travel = travel_on_map(planning::RoutePlanner{hall_with_a_wall(false), {}, {}, plain()});
  EXPECT_TRUE(std::isinf(travel({5, 1}, {7, 1})));
  EXPECT_FALSE(std::isinf(travel({1, 1}, {5, 1})));
}

TEST(Travel, StartsFromWhereTheRobotCannotBe) {
  const auto travel = travel_on_map(planning::RoutePlanner{hall_with_a_wall(true), {}, {}, plain()});
  EXPECT_NEAR(travel({0.15, 2}, {3, 2}), 2.85, 0.5) << "too near to the wall";
  EXPECT_NEAR(travel({-5, 2}, {3, 2}), 8.0, 1e-9) << "outside of the map: as the crow flies";
}

}  // namespace
}  // namespace docent::task_control
