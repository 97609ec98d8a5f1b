#include "docent/apps/laboratory/score_map/reachable_floor.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace docent::apps::score_map_command {
namespace {

simulator::Solid box(Point2 low, Point2 high) {
  simulator::Solid solid;
  solid.polygon = {low, {high.x, low.y}, high, {low.x, high.y}};
  return solid;
}

/// Two rooms of 4 x 4 m, with a wall between them that leaves a door of `door` [m].
ReachableFloor two_rooms(double door) {
  simulator::World world;
  world.floor = {{0, 0}, {8.1, 0}, {8.1, 4}, {0, 4}};
  world.operating_area = world.floor;
  world.solids = {box({4.0, 0.0}, {4.05, 2.0 - 0.5 * door}), box({4.0, 2.0 + 0.5 * door}, {4.05, 4.0})};
  return reachable_floor(world);
}

bool holds(const ReachableFloor& floor, Point2 place) {
  return std::any_of(floor.cells.begin(), floor.cells.end(),
                     [&](Point2 cell) { return distance(cell, place) < floor.step; });
}

TEST(ReachableFloor, EndsWhereTheRobotCannotSee) {
  const ReachableFloor wide = two_rooms(1.2);
  EXPECT_TRUE(holds(wide, {1.0, 0.3}));
  EXPECT_TRUE(holds(wide, {7.0, 0.3}));
  const ReachableFloor narrow = two_rooms(0.5);  // it looks through, and does not drive there
  EXPECT_NE(holds(narrow, {3.85, 0.25}), holds(narrow, {4.25, 0.25}));
  const ReachableFloor shut = two_rooms(0.0);
  EXPECT_NE(holds(shut, {1.0, 2.0}), holds(shut, {7.0, 2.0})) << "doors are thinner than a cell";
}

}  // namespace
}  // namespace docent::apps::score_map_command
