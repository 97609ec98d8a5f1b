#include "docent/mapping/mount_calibration/scan_follower.h"

#include <gtest/gtest.h>

#include "docent/mapping/mount_calibration/testing.h"

namespace docent::mapping::scan_follower_test {
namespace {

TEST(ScanFollower, SeesTheMotionOfTheSensor) {
  const Pose2 mount{0.2, 0.0, Angle::degrees(20.0)};
  ScanFollower follower{{}};
  motion_models::OdometryHistory odometry{std::chrono::seconds{6}};
  testing::TestDrive drive{mount, 0.0, {.noise = 0.0}, 1};
  std::size_t pairs = 0;
  drive.go(
      8.0, [&](Time stamp, const Pose2& odom) { odometry.add(stamp, odom); },
      [&](Time stamp, const auto& reading) {
        follower.keep(stamp, reading);
        for (const MotionPair& pair : follower.follow(odometry, Pose2{0.2, 0.0, {}}, 0.5)) {  // a guess 20 degrees off
          const Pose2 off = inverse(inverse(mount) * pair.base.at(0.0) * mount) * pair.sensor_then_from_now;
          EXPECT_LT(norm(off.position()), 0.03);
          EXPECT_LT(std::abs(off.theta.degrees()), 0.6);
          ++pairs;
        }
      });
  EXPECT_GT(pairs, 12U);
}

/// Pairs of a drive on which again and again somebody steps before the scanner, so that a sweep fits nothing.
std::size_t pairs_among_people(const ScanFollowerParams& params) {
  const Pose2 mount{0.2, 0.0, {}};
  ScanFollower follower{params};
  motion_models::OdometryHistory odometry{std::chrono::seconds{6}};
  testing::TestDrive drive{mount, 0.0, {.noise = 0.0}, 1};
  int sweeps = 0;
  std::size_t pairs = 0;
  drive.go(
      16.0, [&](Time stamp, const Pose2& odom) { odometry.add(stamp, odom); },
      [&](Time stamp, auto reading) {
        std::vector<float> ranges(reading.ranges.begin(), reading.ranges.end());
        if (++sweeps % 9 == 0)
          for (std::size_t i = 0; i < ranges.size(); ++i) ranges[i] = 1.0F + 0.2F * static_cast<float>(i % 7);
        reading.ranges = ranges;
        follower.keep(stamp, reading);
        for (const MotionPair& pair : follower.follow(odometry, mount, 0.8)) {
          const Pose2 off = inverse(inverse(mount) * pair.base.at(0.0) * mount) * pair.sensor_then_from_now;
          EXPECT_LT(norm(off.position()), 0.03);
          EXPECT_LT(std::abs(off.theta.degrees()), 0.6);
          ++pairs;
        }
      });
  return pairs;
}

TEST(ScanFollower, WhatLayOnAnotherBeforeTheViewChangedIsAPair) {
  ScanFollowerParams whole;  // only what was seen of the whole way counts
  whole.least_way = whole.least_turn = 1e3;
  EXPECT_GT(pairs_among_people({}), pairs_among_people(whole));
  EXPECT_GT(pairs_among_people({}), 12U);
}

TEST(ScanFollower, OfARobotThatStandsSaysNothing) {
  ScanFollower follower{{}};
  motion_models::OdometryHistory odometry;
  const std::vector<float> ranges(180, 3.0F);
  for (int i = 0; i < 100; ++i) {
    const Time now = time_from_seconds(0.1 * i);
    odometry.add(now, {});
    follower.keep(now, {ranges, Angle::degrees(-90.0), Angle::degrees(1.0).radians(), 0.02, 10.0});
    EXPECT_TRUE(follower.follow(odometry, {}, 0.5).empty());
  }
}

}  // namespace
}  // namespace docent::mapping::scan_follower_test
