#include "docent/interaction/head/neck.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "docent/base/random.h"

namespace docent::interaction {
namespace {

constexpr double kTick = 0.1;  // [s]

GazeTarget target_at(double pan, double tilt = 0.0) { return {LookAt::goal, 0, Angle::radians(pan).radians(), tilt}; }

/// Steps through a target that moves with time; looks at each step.
void follow(
    Neck& neck, double from_s, double time_s, const std::function<GazeTarget(double)>& target,
    const std::function<void(double)>& look = [](double) {}) {
  const auto steps = static_cast<int>(std::lround(time_s / kTick));
  for (int i = 0; i <= steps; ++i) {
    const double now = from_s + i * kTick;
    neck.step(target(now), time_from_seconds(now));
    look(now);
  }
}

TEST(Neck, ReachesAnyTargetInItsRangeAndStaysThere) {
  Rng rng{1};
  for (int trial = 0; trial < 100; ++trial) {
    Neck neck{{}};
    const double pan = rng.uniform(-2.4, 2.4);
    const double tilt = rng.uniform(-0.6, 0.6);
    follow(neck, 0.0, 6.0, [&](double) { return target_at(pan, tilt); });
    EXPECT_NEAR(neck.pan().position, pan, 0.01);
    EXPECT_NEAR(neck.tilt().position, tilt, 0.01);
    EXPECT_NEAR(neck.pan().velocity, 0.0, 0.02);
  }
}

TEST(Neck, KeepsToTheLimitsOfItsJoints) {
  const NeckParams params;
  Rng rng{2};
  for (int trial = 0; trial < 50; ++trial) {
    Neck neck{params};
    JointState before;
    GazeTarget target;
    follow(
        neck, 0.0, 30.0,
        [&](double) {
          if (rng.chance(0.1)) target = target_at(rng.uniform(-4.0, 4.0), rng.uniform(-2.0, 2.0));
          return target;
        },
        [&](double) {
          EXPECT_LE(std::abs(neck.pan().position), params.pan_range);
          EXPECT_LE(std::abs(neck.tilt().position), params.tilt_range);
          EXPECT_LE(std::abs(neck.pan().position - before.position), params.pan_speed * kTick + 1e-9);
          EXPECT_LE(std::abs(neck.pan().velocity), params.pan_speed);
          const bool is_at_end = std::abs(neck.pan().position) >= params.pan_range;  // there the joint stops at once
          EXPECT_TRUE(is_at_end ||
                      std::abs(neck.pan().velocity - before.velocity) <= params.acceleration * kTick + 1e-9);
          before = neck.pan();
        });
  }
}

TEST(Neck, DoesNotOvershoot) {
  for (const double pan : {0.1, 0.5, 2.0, -1.0}) {
    Neck neck{{}};
    double farthest = 0.0;
    follow(
        neck, 0.0, 6.0, [&](double) { return target_at(pan); },
        [&](double) { farthest = std::max(farthest, neck.pan().position / pan); });
    EXPECT_LT(farthest, 1.05) << pan;
  }
}

TEST(Neck, FollowsATargetUnderWhichTheRobotTurns) {
  Neck neck{{}};
  double largest = 0.0;
  follow(
      neck, 0.0, 5.0, [](double now) { return target_at(1.5 - 0.6 * now); },
      [&](double now) {
        if (now > 2.0) largest = std::max(largest, std::abs(neck.pan().position - (1.5 - 0.6 * now)));
      });
  EXPECT_LT(largest, 0.03) << "no lag, though the head settles slowly";
}

TEST(Neck, DoesNotSwingFromEndToEndWhileTheTargetIsBehind) {
  Neck neck{{}};
  follow(neck, 0.0, 4.0, [](double) { return target_at(2.4); });
  follow(neck, 4.0, 4.0, [](double now) { return target_at(now < 6.0 ? 3.1 : -3.1); });
  EXPECT_NEAR(neck.pan().position, 2.4, 0.01) << "just past the back it stays at its end";
  follow(neck, 8.0, 6.0, [](double) { return target_at(-2.3); });
  EXPECT_NEAR(neck.pan().position, -2.3, 0.01) << "where it can look, it does";
}

TEST(Neck, AGapAndAClockThatFallsMoveNothing) {
  Neck neck{{}};
  follow(neck, 0.0, 0.5, [](double) { return target_at(2.0); });
  const double before = neck.pan().position;
  EXPECT_GT(before, 0.0);
  neck.step(target_at(2.0), time_from_seconds(100.0));
  EXPECT_EQ(neck.pan().position, before);
  EXPECT_EQ(neck.pan().velocity, 0.0);
  neck.step(target_at(2.0), time_from_seconds(50.0));
  EXPECT_EQ(neck.pan().position, before);
}

TEST(NeckParams, HaveBounds) {
  EXPECT_TRUE(NeckParams{}.validate());
  for (const NeckParams& bad :
       {NeckParams{0.0}, NeckParams{4.0}, NeckParams{2.4, 2.0}, NeckParams{2.4, 0.6, 0.0},
        NeckParams{2.4, 0.6, 1.5, 0.0}, NeckParams{2.4, 0.6, 1.5, 0.8, 0.0}, NeckParams{2.4, 0.6, 1.5, 0.8, 6.0, 0.0}})
    EXPECT_FALSE(bad.validate());
}

}  // namespace
}  // namespace docent::interaction
