#include "docent/motion_models/unbroken_odometry.h"

#include <gtest/gtest.h>

#include <cmath>

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

/// Sixty seconds at 0.7 m/s; `stamp_of` says by what stamp a reading of then comes.
template <class Stamp>
int jumps_of(double rate, Stamp stamp_of) {
  UnbrokenOdometry odometry;
  Pose2 raw;
  int jumps = 0;
  for (double now = 0.0; now < 60.0; now += 1.0 / rate) {
    raw = raw * Pose2{0.7 / rate, 0.0, Angle::radians(0.2 / rate)};
    const auto reading = odometry.add(time_from_seconds(100.0 + stamp_of(now)), raw);
    jumps += reading.jumped ? 1 : 0;
    if (!reading.is_late) {
      EXPECT_LT(apart(reading.odom_from_base, raw), 1e-9);
    }
  }
  return jumps;
}

TEST(UnbrokenOdometry, AClockThatIsSetBackIsNoJump) {
  for (const double rate : {10.0, 20.0, 30.0, 50.0, 100.0})
    for (double back = 0.002; back < 3.0; back *= 1.3)
      EXPECT_EQ(jumps_of(rate, [&](double t) { return t < 5.0 ? t : t - back; }), 0) << rate << " " << back;
}

TEST(UnbrokenOdometry, AStallOfADriverThatStampsOnArrivalIsNoJump) {
  for (const double rate : {10.0, 20.0, 50.0, 100.0})
    for (double held = 0.02; held < 1.0; held *= 1.2)
      EXPECT_EQ(jumps_of(rate,
                         [&](double t) {
                           const double into = std::fmod(t, 3.0);
                           return into < held ? t - into + held + 0.02 * into : t;
                         }),
                0)
          << rate << " " << held;
}

TEST(UnbrokenOdometry, JitterIsNoJump) {
  Rng rng{4};
  for (const double rate : {10.0, 20.0, 50.0, 100.0})
    for (const double jitter : {0.005, 0.02, 0.05, 0.1})
      EXPECT_EQ(jumps_of(rate, [&](double t) { return t + rng.uniform(0.0, jitter); }), 0) << rate << " " << jitter;
}

TEST(UnbrokenOdometry, DoublesAndOvertakenOnesTellNothing) {
  UnbrokenOdometry odometry;
  odometry.add(time_from_seconds(1.0), {1.0, 0.0, {}});
  odometry.add(time_from_seconds(1.05), {1.02, 0.0, {}});
  const auto doubled = odometry.add(time_from_seconds(1.05), {1.02, 0.0, {}});
  EXPECT_TRUE(doubled.is_late);
  const auto overtaken = odometry.add(time_from_seconds(1.0), {1.0, 0.0, {}});
  EXPECT_TRUE(overtaken.is_late);
  EXPECT_EQ(overtaken.odom_from_base.x, 1.02);
  EXPECT_FALSE(odometry.add(time_from_seconds(1.1), {1.04, 0.0, {}}).is_late);
}

TEST(UnbrokenOdometry, OfABurstOfOneStampTheNewestCounts) {
  UnbrokenOdometry odometry;
  for (int i = 0; i < 20; ++i) odometry.add(time_from_seconds(0.05 * i), {0.035 * i, 0.0, {}});
  for (int i = 20; i < 24; ++i) {
    const auto reading = odometry.add(time_from_seconds(1.2), {0.035 * i, 0.0, {}});
    EXPECT_FALSE(reading.jumped);
    EXPECT_NEAR(reading.odom_from_base.x, 0.035 * i, 1e-9);
  }
}

TEST(UnbrokenOdometry, BeginningAnewAtZeroIsAJumpAfterAnyPause) {
  for (const double pause : {0.05, 0.5, 5.0, 60.0}) {
    Drive drive;
    UnbrokenOdometry odometry;
    for (int i = 0; i < 40; ++i) {
      drive.step();
      odometry.add(drive.now, drive.odom_from_base);
    }
    const auto reading = odometry.add(drive.now + seconds(pause), {});
    EXPECT_TRUE(reading.jumped) << pause;
    EXPECT_LT(apart(reading.odom_from_base, drive.odom_from_base), 0.45) << "at most half a second of driving on";
    EXPECT_FALSE(odometry.add(drive.now + seconds(pause + 0.05), {0.01, 0.0, {}}).jumped);
  }
}

TEST(UnbrokenOdometry, AFasterBaseMayGoFarther) {
  for (const double speed : {0.5, 2.0}) {
    UnbrokenOdometry odometry{BaseReach{speed, 1.2}};
    odometry.add(time_from_seconds(1.0), {});
    odometry.add(time_from_seconds(2.0), {0.4, 0.0, {}});
    EXPECT_EQ(odometry.add(time_from_seconds(3.0), {2.4, 0.0, {}}).jumped, speed < 1.0);
  }
}

TEST(UnbrokenOdometry, WhoWasNotHeardForLongAndIsElsewhereHasBegunAnew) {
  for (const double pause : {1.5, 4.0, 60.0}) {
    for (const Pose2& anew : {Pose2{0.01, 0.0, Angle::radians(0.004)}, Pose2{-7.0, 3.0, Angle::degrees(50.0)}}) {
      Drive drive;
      UnbrokenOdometry odometry;
      for (int i = 0; i < 200; ++i, drive.step()) (void)odometry.add(drive.now, drive.odom_from_base);
      ASSERT_GT(norm(drive.odom_from_base.position()), 1.0);
      const auto reading = odometry.add(drive.now + seconds(pause), anew);
      EXPECT_TRUE(reading.jumped) << pause;
      EXPECT_LT(apart(reading.odom_from_base, drive.odom_from_base), 0.7) << "what it may have rolled on";
    }
  }
}

TEST(UnbrokenOdometry, WhoWasNotHeardAndIsNearbyHasDriven) {
  Drive drive;
  UnbrokenOdometry odometry;
  for (int i = 0; i < 200; ++i, drive.step()) (void)odometry.add(drive.now, drive.odom_from_base);
  for (const double pause : {0.5, 1.5, 30.0}) {
    drive.now = drive.now + seconds(pause);
    drive.odom_from_base = drive.odom_from_base * Pose2{0.5, 0.0, Angle::radians(0.3)};
    EXPECT_FALSE(odometry.add(drive.now, drive.odom_from_base).jumped) << pause;
    for (int i = 0; i < 20; ++i, drive.step())
      EXPECT_FALSE(odometry.add(drive.now + seconds(kStep), drive.odom_from_base).jumped);
  }
}

TEST(UnbrokenOdometry, InARecordingNobodyStoppedIt) {
  UnbrokenOdometry odometry{BaseReach::of_any()};
  for (int i = 0; i < 20; ++i) (void)odometry.add(time_from_seconds(0.05 * i), {1.0, 0.0, {}});
  EXPECT_FALSE(odometry.add(time_from_seconds(11.0), {9.0, 0.0, {}}).jumped);
}

}  // namespace
}  // namespace docent::motion_models
