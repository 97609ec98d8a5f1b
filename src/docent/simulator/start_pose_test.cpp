#include "docent/simulator/start_pose.h"

#include <gtest/gtest.h>

namespace docent::simulator::start_pose_test {
namespace {

Polygon box(double x, double y, double width, double depth) {
  return {{x, y}, {x + width, y}, {x + width, y + depth}, {x, y + depth}};
}

/// Two rooms of 6 x 6 m with a doorway of `width` in the wall of 0.4 m between them; the home is in the left one.
World two_rooms(double width) {
  World world;
  world.floor = box(0.0, 0.0, 12.4, 6.0);
  world.operating_area = world.floor;
  world.home = {3.0, 3.0};
  world.entrances = {world.home};
  const double below = 3.0 - 0.5 * width;
  world.solids.push_back({"wall-1", SolidKind::wall, box(6.0, 0.0, 0.4, below), 0.0, 3.0, false});
  world.solids.push_back(
      {"wall-2", SolidKind::wall, box(6.0, below + width, 0.4, 6.0 - below - width), 0.0, 3.0, false});
  return world;
}

int starts_in_right_room(const World& world) {
  const WalkableFloor floor{world};
  int found = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Rng rng{seed};
    const auto start = random_start(world, floor, rng);
    EXPECT_TRUE(start);
    if (start && start->x > 6.4) ++found;
  }
  return found;
}

TEST(RandomStart, LiesWhereARobotCanDriveHome) {
  EXPECT_GT(starts_in_right_room(two_rooms(1.4)), 10);
  // A person walks through, but a planner that keeps 0.1 m beyond the robot's body off walls finds no way.
  EXPECT_EQ(starts_in_right_room(two_rooms(0.8)), 0);
}

TEST(RandomStart, KeepsOutOfPartsBehindANarrowNeckOfTheArea) {
  World world = two_rooms(1.4);
  world.operating_area = {{0.0, 0.0},  {6.0, 0.0}, {6.0, 2.8}, {6.4, 2.8}, {6.4, 0.0}, {12.4, 0.0},
                          {12.4, 6.0}, {6.4, 6.0}, {6.4, 3.2}, {6.0, 3.2}, {6.0, 6.0}, {0.0, 6.0}};
  EXPECT_EQ(starts_in_right_room(world), 0) << "the neck of 0.4 m leaves the centre no room";
}

TEST(RandomStart, KeepsOutOfPartsBehindAHazard) {
  World world = two_rooms(1.4);
  world.solids.push_back({"plate", SolidKind::plate, box(6.0, 2.9, 0.4, 0.2), 0.0, 0.02, false});
  EXPECT_EQ(starts_in_right_room(world), 0);
}

TEST(RandomStart, IsTheSameForASeed) {
  const World world = two_rooms(1.4);
  const WalkableFloor floor{world};
  Rng one{7};
  Rng other{7};
  const auto a = random_start(world, floor, one);
  const auto b = random_start(world, floor, other);
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->x, b->x);
  EXPECT_EQ(a->theta.radians(), b->theta.radians());
}

}  // namespace
}  // namespace docent::simulator::start_pose_test
