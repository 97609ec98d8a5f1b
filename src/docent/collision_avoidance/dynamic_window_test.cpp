#include "docent/collision_avoidance/dynamic_window.h"

#include <gtest/gtest.h>

#include "docent/base/random.h"

namespace docent {
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

/// The promise of safety rule 2: whatever was chosen can be held until the watchdog bites, and then braked, and nothing
/// is touched; and the same at every later moment when full braking comes instead.
TEST(DynamicWindow, EveryChoiceCanBeBrakedWheneverWeDie) {
  const BaseLimits limits;
  int chosen = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    Rng rng{seed};
    DynamicWindow window{limits, {}};
    std::vector<Obstacle> obstacles;
    for (int i = 0; i < 25; ++i) {
      const Obstacle obstacle = real_at(rng.uniform(-2.0, 2.0), rng.uniform(-2.0, 2.0));
      if (norm(obstacle.at) > 0.36) obstacles.push_back(obstacle);
    }
    const Velocity velocity{rng.uniform(0.0, 0.4), rng.uniform(-0.5, 0.5)};
    const Steering steering{rng.uniform(-2.0, 2.0), 2.0, 0.7, false};
    const auto choice = window.choose(velocity, velocity, obstacles, steering);
    if (choice.is_braking || choice.command.linear == 0.0) continue;
    ++chosen;
    for (const double silence : {0.0, 0.1, 0.2, window.hold()}) {
      BaseState state{{}, velocity};
      for (double time = 0.0; time < 3.0; time += 0.01) {
        state = advance(state, time < silence ? choice.command : Velocity{}, limits, 0.01);
        for (const auto& obstacle : obstacles) {
          ASSERT_GT(distance(obstacle.at, state.odom_from_base.position()), limits.radius + 0.05)
              << "seed " << seed << ", silence " << silence << " s, at " << time << " s";
        }
      }
    }
  }
  EXPECT_GT(chosen, 150);
}

TEST(DynamicWindow, StaysInsideWhatTheBaseCanReach) {
  const BaseLimits limits;
  DynamicWindow window{limits, {}};
  const Velocity velocity{0.3, 0.2};
  const auto choice = window.choose(velocity, velocity, {}, {0.4, 3.0, 0.7, false});
  for (const auto& candidate : choice.window) {
    EXPECT_GE(candidate.velocity.linear, 0.3 - 0.25 - 1e-9);
    EXPECT_LE(candidate.velocity.linear, 0.3 + 0.125 + 1e-9);
    EXPECT_LE(std::abs(candidate.velocity.angular - 0.2), 0.375 + 1e-9);
  }
  EXPECT_GT(choice.command.linear, 0.4);
  EXPECT_GT(choice.command.angular, 0.3);
}

TEST(DynamicWindow, ParametersAreChecked) {
  DynamicWindowParams params;
  EXPECT_TRUE(params.validate());
  params.real_margin = 0.0;
  EXPECT_FALSE(params.validate());
  params = {};
  params.linear_steps = 1000;
  EXPECT_FALSE(params.validate());
}

}  // namespace
}  // namespace docent
