#include "docent/motion_models/unbroken_odometry.h"

#include <gtest/gtest.h>

#include "docent/base/random.h"

namespace docent::motion_models {
namespace {

constexpr double kStep = 0.05;  // [s]

/// A base that drives an arc; its odometry is what is told to `odometry`.
struct Drive {
  double linear = 0.5;   // [m/s]
  double angular = 0.3;  // [rad/s]
  Pose2 odom_from_base;
  Time now{};

  void step() {
    now = now + seconds(kStep);
    odom_from_base = odom_from_base * Pose2{linear * kStep, 0.0, Angle::radians(angular * kStep)};
  }
};

double apart(const Pose2& a, const Pose2& b) {
  return distance(a.position(), b.position()) + std::abs((a.theta - b.theta).radians());
}

TEST(UnbrokenOdometry, LeavesADriveAsItIs) {
  Drive drive;
  UnbrokenOdometry odometry;
  Rng rng{7};
  for (int i = 0; i < 400; ++i) {
    if (i % 40 == 0) {  // starts and stops as hard as wheels can
      drive.linear = rng.chance(0.3) ? 0.0 : rng.uniform(-0.2, 0.8);
      drive.angular = rng.uniform(-0.5, 0.5);
    }
    drive.step();
    const auto reading = odometry.add(drive.now, drive.odom_from_base);
    ASSERT_FALSE(reading.jumped) << i;
    ASSERT_LT(apart(reading.odom_from_base, drive.odom_from_base), 1e-9);
  }
}

TEST(UnbrokenOdometry, TakesOutJumpsAndGoesOn) {
  for (const Pose2& jump :
       {Pose2{0.3, 0.0, {}}, Pose2{0.0, 0.0, Angle::degrees(15)}, Pose2{-4.0, 9.0, Angle::degrees(120)}}) {
    Drive drive;
    UnbrokenOdometry odometry;
    Pose2 raw_from_true;
    for (int i = 0; i < 200; ++i) {
      drive.step();
      if (i == 100) raw_from_true = jump;
      const auto reading = odometry.add(drive.now, raw_from_true * drive.odom_from_base);
      EXPECT_EQ(reading.jumped, i == 100);
      EXPECT_LT(apart(reading.odom_from_base, drive.odom_from_base), 0.01) << i;
    }
    // What was said in the odometry's own frame, before and after.
    const Pose2 place{1.0, 2.0, {}};
    EXPECT_LT(apart(odometry.odom_from_raw(time_from_seconds(1.0)) * place, place), 1e-9);
    EXPECT_LT(apart(odometry.odom_from_raw(drive.now) * jump * place, place), 0.05);
  }
}

TEST(UnbrokenOdometry, AStandingRobotsOdometryMayJumpToo) {
  UnbrokenOdometry odometry;
  for (int i = 0; i < 100; ++i) odometry.add(time_from_seconds(i * kStep), {});
  EXPECT_TRUE(odometry.add(time_from_seconds(5.0), {0.5, 0.0, {}}).jumped);
}

TEST(UnbrokenOdometry, WhatFrozeInFullDriveIsBelievedWhereItWakes) {
  Drive drive;
  UnbrokenOdometry odometry;
  Pose2 last;
  for (int i = 0; i < 200; ++i) {
    drive.step();
    if (i < 100 || i >= 120) last = drive.odom_from_base;
    const auto reading = odometry.add(drive.now, last);
    EXPECT_FALSE(reading.jumped) << i;
    if (i >= 120) {
      EXPECT_LT(apart(reading.odom_from_base, drive.odom_from_base), 1e-9);
    }
  }
}

TEST(UnbrokenOdometry, MissingMessagesAreNoJump) {
  Drive drive;
  UnbrokenOdometry odometry;
  for (int i = 0; i < 200; ++i) {
    drive.step();
    if (i > 100 && i < 110) continue;  // half a second
    if (i % 2 == 0) {
      EXPECT_FALSE(odometry.add(drive.now, drive.odom_from_base).jumped);
    }
  }
}

}  // namespace
}  // namespace docent::motion_models
