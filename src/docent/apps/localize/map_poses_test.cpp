#include "docent/apps/localize/map_poses.h"

#include <gtest/gtest.h>

#include "docent/base/time.h"

namespace docent::apps::localize_command {
namespace {

/// A robot that drives 1 m in ten steps before a wall, with a laser ahead of its centre.
recording::LaserLog drive(bool has_rear) {
  recording::LaserLog log;
  log.max_range = 10.0;
  for (int i = 0; i <= 10; ++i) {
    recording::LoggedScan scan;
    scan.time = time_from_seconds(0.5 * i);
    scan.first_bearing = Angle::degrees(-10);
    scan.bearing_step = Angle::degrees(1).radians();
    scan.ranges.assign(21, 3.0F);
    scan.odom_from_base = {0.1 * i, 0.0, {}};
    scan.base_from_laser = {0.2, 0.0, {}};
    log.scans.push_back(scan);
    if (!has_rear) continue;
    scan.rear = true;
    scan.time = time_from_seconds(0.5 * i + 0.02);
    scan.base_from_laser = {-0.2, 0.0, Angle::degrees(180)};
    log.scans.push_back(scan);
  }
  return log;
}

TEST(ChooseScans, TakesThoseAfterAWay) {
  const ChosenScans chosen = choose_scans(drive(false), {0.25, 90.0}, {});
  EXPECT_EQ(chosen.indices, (std::vector<std::size_t>{0, 3, 6, 9}));
  EXPECT_EQ(chosen.sources, chosen.indices);
  EXPECT_NEAR(chosen.scans[1].points[10].at.x, 3.2, 1e-6) << "seen from the base";
}

TEST(ChooseScans, PutsTwoLasersTogether) {
  const ChosenScans chosen = choose_scans(drive(true), {0.25, 90.0}, {});
  ASSERT_EQ(chosen.scans.size(), 4U);
  EXPECT_EQ(chosen.sources.size(), 8U);
  EXPECT_EQ(chosen.scans[0].points.size(), 42U);
  EXPECT_EQ(chosen.scans[0].sensors.size(), 2U);
}

TEST(PosesOfAll, FollowOdometryAndMeetTheKnownOnes) {
  const auto log = drive(false);
  const std::vector<std::size_t> indices{0, 5};
  const std::vector<Pose2> known{{0.0, 0.0, {}}, {0.6, 0.0, {}}};  // odometry says 0.5
  const auto poses = poses_of_all(log, indices, known);
  ASSERT_EQ(poses.size(), 11U);
  EXPECT_NEAR(poses[0].x, 0.0, 1e-9);
  EXPECT_NEAR(poses[2].x, 0.24, 1e-9);
  EXPECT_NEAR(poses[5].x, 0.6, 1e-9);
  EXPECT_NEAR(poses[10].x, 1.1, 1e-9);
}

}  // namespace
}  // namespace docent::apps::localize_command
