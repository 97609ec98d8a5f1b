#include "docent/collision_avoidance/avoider/virtual_obstacles.h"

#include <gtest/gtest.h>

#include <numbers>

namespace docent::collision_avoidance::virtual_obstacles_test {
namespace {

/// Four directions a turn: behind, right, ahead, left.
VirtualSweep sweep_of(std::vector<float> ranges) {
  return {time_from_seconds(10.0), -std::numbers::pi, 0.5 * std::numbers::pi, 6.0, std::move(ranges)};
}

TEST(VirtualObstacles, StayWhereTheyWereMeasured) {
  VirtualObstacles known;
  std::vector<Obstacle> obstacles;
  known.add_to(obstacles, {}, 5.0);
  EXPECT_TRUE(obstacles.empty());
  EXPECT_FALSE(known.stamp());
  known.take(sweep_of({6.0F, 6.0F, 2.0F, 6.0F}), {1.0, 0.0, {}});
  known.add_to(obstacles, inverse(Pose2{2.0, 0.0, {}}), 5.0);
  ASSERT_EQ(obstacles.size(), 1U);
  EXPECT_NEAR(obstacles[0].at.x, 1.0, 1e-9) << "the robot has driven a metre towards it";
  EXPECT_TRUE(obstacles[0].is_virtual);
  EXPECT_FALSE(obstacles[0].is_border);
  EXPECT_EQ(obstacles[0].margin, VirtualObstaclesParams{}.hazard_margin);
}

TEST(VirtualObstacles, TheSecondTurnIsTheBorder) {
  VirtualObstacles known;
  known.take(sweep_of({6.0F, 6.0F, 6.0F, 6.0F, 6.0F, 1.5F, 0.0F, 6.0F}), {});
  std::vector<Obstacle> obstacles;
  known.add_to(obstacles, {}, 1.0);
  ASSERT_EQ(obstacles.size(), 1U) << "the other one is out of reach";
  EXPECT_TRUE(obstacles[0].is_border);
  EXPECT_EQ(obstacles[0].margin, VirtualObstaclesParams{}.border_margin);
  EXPECT_NEAR(obstacles[0].at.x, 0.02, 1e-9) << "a zero still lies ahead";
}

}  // namespace
}  // namespace docent::collision_avoidance::virtual_obstacles_test
