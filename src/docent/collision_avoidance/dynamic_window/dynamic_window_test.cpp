#include "docent/collision_avoidance/dynamic_window/dynamic_window.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "docent/base/random.h"
#include "docent/collision_avoidance/dynamic_window/slow_window_for_test.h"

namespace docent::collision_avoidance {
namespace {

Obstacle real_at(double x, double y) { return {{x, y}, {}, 0.08, false, false}; }

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
    for (const double silence : {0.0, 0.1, 0.2, limits.hold()}) {
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

struct AnyCase {
  Velocity velocity, last;
  Steering steering;
  std::vector<Obstacle> obstacles;
};

AnyCase any_case(std::uint64_t seed) {
  Rng rng{seed};
  AnyCase one{{rng.uniform(-0.1, 0.7), rng.uniform(-0.8, 0.8)},
              {rng.uniform(0.0, 0.7), rng.uniform(-0.8, 0.8)},
              {rng.uniform(-3.0, 3.0), rng.uniform(0.1, 3.0), rng.uniform(0.0, 0.8), rng.chance(0.3)},
              {}};
  const auto count = rng.integer(0, 80);
  for (int i = 0; i < count; ++i) {
    const Obstacle obstacle = real_at(rng.uniform(-3.0, 3.0), rng.uniform(-3.0, 3.0));
    if (norm(obstacle.at) > 0.36) one.obstacles.push_back(obstacle);
  }
  return one;
}

TEST(DynamicWindow, ChoosesWhatTheSlowTwinChooses) {
  const BaseLimits limits;
  int moving = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    DynamicWindowParams params;
    params.two_second_rule = seed % 3 == 0;
    if (seed % 5 == 0) params.linear_steps = params.angular_steps = 64;
    const AnyCase one = any_case(seed);
    const auto slow = SlowWindow{limits, params}.choose(one.velocity, one.last, one.obstacles, one.steering);
    DynamicWindow window{limits, params};
    const auto fast = window.choose(one.velocity, one.last, one.obstacles, one.steering);
    ASSERT_EQ(fast.command, slow.command) << "seed " << seed;
    ASSERT_EQ(fast.is_braking, slow.is_braking) << "seed " << seed;
    moving += fast.command.linear > 0.05 ? 1 : 0;
  }
  EXPECT_GT(moving, 100);
}

TEST(DynamicWindow, GivesTheSameBitsInEveryInstructionSet) {
  const BaseLimits limits;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const AnyCase one = any_case(seed);
    DynamicWindow plain{limits, {}, InstructionSet::plain};
    const auto wanted = plain.choose(one.velocity, one.last, one.obstacles, one.steering);
    for (const InstructionSet set : instruction_sets()) {
      DynamicWindow window{limits, {}, set};
      const auto choice = window.choose(one.velocity, one.last, one.obstacles, one.steering);
      ASSERT_EQ(choice.command, wanted.command) << name_of(set);
      for (std::size_t i = 0; i < choice.window.size(); ++i) {
        ASSERT_EQ(choice.window[i].value, wanted.window[i].value) << name_of(set);
      }
    }
  }
}

TEST(DynamicWindow, KeepsTwoSecondsAwayWhereTheRuleIsOn) {
  const BaseLimits limits;
  const std::vector wall{real_at(1.345, -0.2), real_at(1.345, 0.0), real_at(1.345, 0.2)};  // a free way of 1 m
  const Steering steering{0.0, 3.0, 0.8, false};
  const Velocity velocity{0.6, 0.0};
  DynamicWindowParams params;
  DynamicWindow without{limits, params};
  EXPECT_GT(without.choose(velocity, velocity, wall, steering).command.linear, 0.55);
  params.two_second_rule = true;
  DynamicWindow with{limits, params};
  const auto choice = with.choose(velocity, velocity, wall, steering);
  for (const auto& candidate : choice.window) {
    if (std::abs(candidate.velocity.angular) < 1e-9 && candidate.value >= 0.0) {
      EXPECT_LE(candidate.velocity.linear, 0.5 + 1e-9);
    }
  }
}

TEST(DynamicWindow, TheSpeedGrowsWithTheGapBeyondTheMargin) {
  const DynamicWindowParams params;
  EXPECT_EQ(params.speed_with(-0.1), params.creep_speed);
  EXPECT_EQ(params.speed_with(0.0), params.creep_speed);
  // [Buhmann1995]: 10 cm from slow speeds on, 30 cm from fast ones.
  EXPECT_NEAR(params.speed_with(0.10 - params.real_margin), 0.25, 0.01);
  EXPECT_NEAR(params.speed_with(0.2999 - params.real_margin), 1.58, 0.01);
  EXPECT_TRUE(std::isinf(params.speed_with(0.30 - params.real_margin + 1e-9)));
}

TEST(DynamicWindow, ABodyWithAnOutlineTouchesNothingEither) {
  BaseLimits limits;
  limits.outline = Outline::make({{0.45, 0.25}, {-0.55, 0.25}, {-0.55, -0.25}, {0.45, -0.25}}).value();
  int chosen = 0;
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    Rng rng{seed};
    DynamicWindow window{limits, {}};
    std::vector<Obstacle> obstacles;
    for (int i = 0; i < 20; ++i) {
      const Obstacle obstacle = real_at(rng.uniform(-2.0, 2.0), rng.uniform(-2.0, 2.0));
      if (limits.outline.distance_to(obstacle.at) > 0.1) obstacles.push_back(obstacle);
    }
    const Velocity velocity{rng.uniform(0.0, 0.4), rng.uniform(-0.5, 0.5)};
    const auto choice = window.choose(velocity, velocity, obstacles, {rng.uniform(-2.0, 2.0), 2.0, 0.7, false});
    if (choice.is_braking || choice.command == Velocity{}) continue;
    ++chosen;
    for (const double silence : {0.0, 0.1, limits.hold()}) {
      BaseState state{{}, velocity};
      for (double time = 0.0; time < 3.0; time += 0.02) {
        state = advance(state, time < silence ? choice.command : Velocity{}, limits, 0.02);
        for (const auto& obstacle : obstacles) {
          ASSERT_GT(limits.outline.distance_to(inverse(state.odom_from_base) * obstacle.at), 0.03)
              << "seed " << seed << ", silence " << silence << " s, at " << time << " s";
        }
      }
    }
  }
  EXPECT_GT(chosen, 40);
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
}  // namespace docent::collision_avoidance
