#include "docent/planning/value_iteration/value_picture.h"

#include <gtest/gtest.h>

#include "docent/planning/value_iteration/route.h"

namespace docent::planning {
namespace {

TEST(ValuePicture, FallsTowardsTheGoalAndKnowsNoWayThroughWalls) {
  OccupancyGrid map;
  map.frame = {120, 60, 0.05, {0.0, 0.0}};
  map.cells.assign(map.frame.size(), OccupancyGrid::kFree);
  for (int row = 0; row < map.frame.rows; ++row)  // a wall without a door, 4 m from the left
    for (int column = 80; column < 84; ++column) map.cells[map.frame.index({column, row})] = OccupancyGrid::kOccupied;
  RouteParams params;
  params.robot_radius = 0.2;
  RoutePlanner planner{map, {}, {}, params};
  planner.set_goal({1.0, 1.5}, 0.1);
  while (!planner.iterate(1000)) {
  }
  const ValuePicture picture = value_picture(planner.values(), 2);
  const auto share = [&](double x, double y) -> int {
    return picture.shares[picture.frame.index(picture.frame.cell_at({x, y}))];
  };
  EXPECT_LE(share(1.0, 1.5), 3);
  EXPECT_GT(share(2.0, 1.5), share(1.0, 1.5));
  EXPECT_GT(share(3.2, 1.5), share(2.0, 1.5));
  EXPECT_EQ(share(5.0, 1.5), -1) << "behind the wall";
  for (const std::int8_t one : picture.shares) EXPECT_TRUE(one >= -1 && one <= 100);
}

}  // namespace
}  // namespace docent::planning
