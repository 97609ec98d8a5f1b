#include "docent/collision_avoidance/body/braking.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace docent::collision_avoidance::braking_test {
namespace {

Obstacle real_at(double x, double y) { return {{x, y}, {}, 0.08, false, false}; }

TEST(CanBrakeInTime, KnownByHand) {
  const BaseLimits limits;
  // 0.6 m/s kept for 0.35 s and braked with 1 m/s2: 0.21 + 0.18 = 0.39 m, and 0.345 m of reach.
  EXPECT_TRUE(can_brake_in_time({0.6, 0.0}, {0.6, 0.0}, 0.35, std::vector{real_at(0.76, 0.0)}, limits, 0.0));
  EXPECT_FALSE(can_brake_in_time({0.6, 0.0}, {0.6, 0.0}, 0.35, std::vector{real_at(0.70, 0.0)}, limits, 0.0));
  EXPECT_TRUE(can_brake_in_time({0.6, 0.0}, {0.6, 0.0}, 0.35, std::vector{real_at(0.0, 0.40)}, limits, 0.0));
}

TEST(CanBrakeInTime, InsideAMarginOnlyTheWayOutIsOpen) {
  const BaseLimits limits;
  const std::vector near{real_at(0.31, 0.0)};
  EXPECT_FALSE(can_brake_in_time({}, {0.1, 0.0}, 0.35, near, limits, 0.0));
  EXPECT_TRUE(can_brake_in_time({}, {-0.1, 0.0}, 0.35, near, limits, 0.0));
  EXPECT_TRUE(can_brake_in_time({}, {0.0, 1.0}, 0.35, near, limits, 0.0));
}

TEST(CanBrakeInTime, ComingPeopleNeedMoreRoom) {
  const BaseLimits limits;
  const Obstacle standing{{1.2, 0.0}, {}, 0.08, true, false};
  const Obstacle coming{{1.2, 0.0}, {-1.2, 0.0}, 0.08, true, false};
  const Obstacle leaving{{0.7, 0.0}, {1.2, 0.0}, 0.08, true, false};
  EXPECT_TRUE(can_brake_in_time({0.6, 0.0}, {0.6, 0.0}, 0.35, std::vector{standing}, limits, 0.0));
  EXPECT_FALSE(can_brake_in_time({0.6, 0.0}, {0.6, 0.0}, 0.35, std::vector{coming}, limits, 0.0));
  EXPECT_TRUE(can_brake_in_time({0.6, 0.0}, {0.6, 0.0}, 0.35, std::vector{leaving}, limits, 0.0));
  EXPECT_TRUE(can_brake_in_time({}, {}, 0.35, std::vector{coming}, limits, 0.0));  // who stands does not push
}

TEST(CanBrakeInTime, ALongBodyDoesNotSwingItsTailIntoAWall) {
  BaseLimits limits;
  limits.outline = Outline::make({{0.3, 0.25}, {-0.7, 0.25}, {-0.7, -0.25}, {0.3, -0.25}}).value();
  std::vector<Obstacle> wall;  // to the right, 15 cm away
  for (double x = -1.5; x < 1.5; x += 0.05) wall.push_back(real_at(x, -0.40));
  EXPECT_FALSE(can_brake_in_time({}, {0.0, 0.8}, 0.35, wall, limits, 0.0));
  EXPECT_TRUE(can_brake_in_time({}, {0.3, 0.0}, 0.35, wall, limits, 0.0));
  BaseLimits disc;
  EXPECT_TRUE(can_brake_in_time({}, {0.0, 0.8}, 0.35, wall, disc, 0.0));
}

TEST(CanBrakeInTime, WhoComesUpToTheRobotDoesNotWalkThroughIt) {
  const BaseLimits limits;
  const Velocity slowly{0.25, 0.0};
  std::vector<Obstacle> person{real_at(-0.35, 0.25)};
  person.front().velocity = {1.6, -0.8};  // at its back, to the left: through it, they would come out before it
  EXPECT_TRUE(can_brake_in_time(slowly, slowly, 0.55, person, limits, 0.0));
  person.front() = real_at(0.75, 0.25);
  person.front().velocity = {-0.8, -0.4};  // from before it
  EXPECT_FALSE(can_brake_in_time(slowly, slowly, 0.55, person, limits, 0.0));
}

TEST(CanBrakeInTime, TheRestOfATurnCountsForABodyThatIsNoDisc) {
  BaseLimits limits;
  limits.outline = Outline::make({{0.5, 0.2}, {-0.5, 0.2}, {-0.5, -0.2}, {0.5, -0.2}}).value();
  // 1.2 rad/s for 0.1 s and then 1.5 rad/s2 against it: 0.12 + 0.48 = 0.6 rad, of which most after the command.
  const auto beyond_corner = [&](double turn, double side) {
    Obstacle post = real_at(0.0, 0.0);
    post.at = 0.5 * unit(Angle::radians(side * (std::atan2(0.2, 0.5) + turn)));
    post.margin = 0.03;
    return std::vector{post};
  };
  for (const double side : {1.0, -1.0}) {
    const Velocity turning{0.0, side * 1.2};
    EXPECT_FALSE(can_brake_in_time(turning, turning, 0.1, beyond_corner(0.5, side), limits, 0.0));
    EXPECT_TRUE(can_brake_in_time(turning, turning, 0.1, beyond_corner(0.9, side), limits, 0.0));
    EXPECT_FALSE(can_brake_in_time(turning, {}, 0.1, beyond_corner(0.4, side), limits, 0.0)) << "braking at once";
    EXPECT_TRUE(can_brake_in_time({}, {}, 0.1, beyond_corner(0.4, side), limits, 0.0));
    auto person = beyond_corner(0.5, side);
    person.front().velocity = {0.0, -0.05 * side};
    EXPECT_FALSE(can_brake_in_time(turning, turning, 0.1, person, limits, 0.0)) << "its corner would push";
  }
}

}  // namespace
}  // namespace docent::collision_avoidance::braking_test
