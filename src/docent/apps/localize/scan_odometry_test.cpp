#include "docent/apps/localize/scan_odometry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "docent/base/time.h"

namespace docent::apps::localize_command {
namespace {

struct Wall {
  Point2 from, to;
};

/// [m] to the nearest wall along a ray; infinite: none within 12 m.
float range_of(const std::vector<Wall>& walls, const Pose2& ray) {
  const double c = std::cos(ray.theta.radians()), s = std::sin(ray.theta.radians());
  double nearest = 12.0;
  for (const Wall& wall : walls) {
    const double ex = wall.to.x - wall.from.x, ey = wall.to.y - wall.from.y;
    const double wx = wall.from.x - ray.x, wy = wall.from.y - ray.y;
    const double across = c * ey - s * ex;
    if (std::abs(across) < 1e-12) continue;
    const double along_ray = (wx * ey - wy * ex) / across, along_wall = (wx * s - wy * c) / across;
    if (along_ray > 0.0 && along_wall >= 0.0 && along_wall <= 1.0) nearest = std::min(nearest, along_ray);
  }
  return nearest < 12.0 ? static_cast<float>(nearest) : std::numeric_limits<float>::infinity();
}

/// Ten scans a second of 270 degrees; where the robot truly was goes to logged_pose, odometry says nothing.
recording::LaserLog drive(const std::vector<Wall>& walls, const Pose2& start, double speed, double turn_rate, int scans,
                          bool has_rear) {
  recording::LaserLog log;
  log.max_range = 12.0;
  Pose2 pose = start;
  for (int i = 0; i < scans; ++i) {
    recording::LoggedScan scan;
    scan.time = time_from_seconds(100.0 + 0.1 * i);
    scan.first_bearing = Angle::degrees(-135);
    scan.bearing_step = Angle::degrees(0.75).radians();
    scan.base_from_laser = {0.15, 0.0, {}};
    scan.logged_pose = pose;
    for (const bool rear : {false, true}) {
      if (rear && !has_rear) continue;
      scan.rear = rear;
      if (rear) scan.base_from_laser = {-0.15, 0.0, Angle::degrees(180)};
      scan.ranges.clear();
      for (int beam = 0; beam <= 360; ++beam)
        scan.ranges.push_back(range_of(
            walls, pose * scan.base_from_laser * Pose2{0.0, 0.0, scan.bearing(static_cast<std::size_t>(beam))}));
      log.scans.push_back(scan);
    }
    pose = pose * Pose2{0.1 * speed, 0.0, Angle::radians(0.1 * turn_rate)};
  }
  return log;
}

std::vector<Wall> hall() {
  return {{{0, 0}, {9, 0}},       {{9, 0}, {9, 6}},         {{9, 6}, {0, 6}},       {{0, 6}, {0, 0}},
          {{4, 2.8}, {4.6, 2.8}}, {{4.6, 2.8}, {4.6, 3.2}}, {{4.6, 3.2}, {4, 3.2}}, {{4, 3.2}, {4, 2.8}}};
}

TEST(ScanOdometry, FollowsADriveInAHall) {
  for (const bool has_rear : {false, true}) {
    auto log = drive(hall(), {3.2, 1.0, {}}, 0.5, 0.25, 250, has_rear);
    ASSERT_TRUE(has_no_odometry(log));
    const ScanOdometry found = odometry_by_scans(log, {});
    EXPECT_EQ(found.steps, 249U);
    EXPECT_LE(found.blind, 2U);
    EXPECT_EQ(found.doubt(), "");
    EXPECT_FALSE(has_no_odometry(log));
    const Pose2 first = log.scans.front().logged_pose;
    for (const recording::LoggedScan& scan : log.scans) {
      const Pose2 truly = inverse(first) * scan.logged_pose;
      EXPECT_NEAR(distance(scan.odom_from_base.position(), truly.position()), 0.0, 0.15);
      EXPECT_NEAR((scan.odom_from_base.theta - truly.theta).degrees(), 0.0, 3.0);
    }
  }
}

TEST(ScanOdometry, ABarePassageAndAnEmptyPlainTellNoMotionAlongThem) {
  const std::vector<Wall> passage{{{-100, 0}, {100, 0}}, {{-100, 2}, {100, 2}}};
  auto log = drive(passage, {0, 1, {}}, 0.5, 0.0, 60, false);
  EXPECT_NE(odometry_by_scans(log, {}).doubt().find("do not tell how the robot moved"), std::string::npos);
  auto plain = drive({}, {0, 1, {}}, 0.5, 0.0, 20, false);
  const ScanOdometry nothing = odometry_by_scans(plain, {});
  EXPECT_EQ(nothing.blind, nothing.steps);
  EXPECT_FALSE(nothing.doubt().empty());
}

TEST(ScanOdometry, ARobotThatStandsStands) {
  auto log = drive(hall(), {1.5, 1.2, {}}, 0.0, 0.0, 40, false);
  EXPECT_EQ(odometry_by_scans(log, {}).doubt(), "");
  for (const recording::LoggedScan& scan : log.scans) EXPECT_LT(norm(scan.odom_from_base.position()), 0.01);
  log.scans.resize(1);
  EXPECT_FALSE(has_no_odometry(log)) << "one scan has no way";
}

}  // namespace
}  // namespace docent::apps::localize_command
