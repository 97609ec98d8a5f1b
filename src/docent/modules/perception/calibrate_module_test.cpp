#include "docent/modules/perception/calibrate_module.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "docent/geometry/polygon.h"
#include "docent/modules/shared/module_bench.h"
#include "docent/modules/shared/scanners.h"
#include "docent/modules/shared/sensor_time.h"

namespace docent::modules::calibrate_module_test {
namespace {

/// A robot with one scanner that drives in an L of walls; the scanner looks 12 degrees to the left of what is said.
class CalibrateModule : public ModuleBench {
 protected:
  CalibrateModule() : ModuleBench{"calibrate", make_calibrate} {
    EXPECT_TRUE(config.set("body.scanners=[{name: front, frame: laser, field: 180}]"));
    keep(topics::kCalibration, calibration, count);
    world->every(seconds(0.05), [this] { tick(); });
  }

  void tick() {
    const double t = now_s();
    const bool turns = std::fmod(t, 8.0) > 6.0;
    const Pose2 step{turns ? 0.0 : 0.02, 0.0, Angle::radians(turns ? 0.05 : 0.0)};
    pose = pose * step;
    nav_msgs::Odometry odometry;
    odometry.header = {to_message(world->now()), "odom"};
    odometry.pose.pose = to_message(pose);
    odometries.publish(odometry);
    if (++ticks % 2 == 0) publish_scan();
  }

  void publish_scan() {
    sensor_msgs::LaserScan scan;
    scan.header = {to_message(world->now()), "laser"};
    scan.angle_min = static_cast<float>(-0.5 * std::numbers::pi);
    scan.angle_increment = static_cast<float>(std::numbers::pi / 180.0);
    scan.angle_max = -scan.angle_min;
    scan.range_min = 0.02F;
    scan.range_max = 12.0F;
    const Pose2 sensor = pose * true_mount;
    for (int i = 0; i <= 180; ++i) {
      const Point2 ray = unit(sensor.theta + Angle::degrees(i - 90.0));
      double range = 12.0;
      for (const Segment& wall : walls)
        if (const auto hit = ray_distance(sensor.position(), ray, wall)) range = std::min(range, *hit);
      scan.ranges.push_back(static_cast<float>(range));
    }
    if (hangs) std::reverse(scan.ranges.begin(), scan.ranges.end());
    scans.publish(scan);
  }

  std::vector<Segment> walls = [] {
    std::vector<Segment> all = sides({{-4, -4}, {4, -4}, {4, 1}, {6, 1}, {6, 5}, {-4, 5}});
    for (const Segment& side : sides({{1.5, 2.5}, {2.0, 2.5}, {2.0, 3.0}})) all.push_back(side);
    return all;
  }();
  Pose2 true_mount = Pose2{0.0, 0.0, Angle::degrees(12.0)};
  bool hangs = false;  ///< and nobody says so
  Pose2 pose;
  int ticks = 0;
  docent_msgs::Calibration calibration;
  int count = 0;
  transport::Publisher<nav_msgs::Odometry> odometries = world->publisher(topics::kOdometry);
  transport::Publisher<sensor_msgs::LaserScan> scans = world->publisher(topics::scan_topic("front"));
};

TEST_F(CalibrateModule, IsSlowAtFirstThenNamesWhatIsWrongAndRemembersIt) {
  start();
  run(0.2);
  ASSERT_FALSE(calibration.mounts.empty());
  EXPECT_GT(calibration.most_speed, 0.0);
  EXPECT_GT(calibration.mounts[0].doubt_heading, 0.05);
  EXPECT_EQ(module->health().state, "ready");
  run(60.0);
  EXPECT_EQ(module->health().state, "degraded");
  EXPECT_NE(module->health().reason.find("scanner front: turned by +1"), std::string::npos) << module->health().reason;
  EXPECT_NEAR(calibration.mounts[0].heading, Angle::degrees(12.0).radians(), 0.02);
  start();
  run(0.2);
  EXPECT_TRUE(calibration.mounts[0].is_known) << "after a new start";
  EXPECT_NEAR(calibration.mounts[0].heading, Angle::degrees(12.0).radians(), 0.02);
}

TEST_F(CalibrateModule, NamesAScannerThatHangsUnsaidAndCreeps) {
  true_mount = {};
  hangs = true;
  start();
  run(40.0);
  EXPECT_EQ(module->health().state, "degraded");
  EXPECT_NE(module->health().reason.find("scanner front: mirrors left and right"), std::string::npos)
      << module->health().reason;
  EXPECT_NEAR(calibration.most_speed, 0.1, 1e-9);
  EXPECT_NE(calibration.finding.find("write upside_down: true"), std::string::npos);
  ASSERT_TRUE(config.set("body.scanners=[{name: front, frame: laser, field: 180, upside_down: true}]"));
  start();
  run(40.0);
  EXPECT_EQ(module->health().reason.find("mirrors"), std::string::npos) << module->health().reason;
}

TEST_F(CalibrateModule, OthersTakeWhatItFound) {
  std::vector<ScannerPlace> places;
  std::vector<Time> stamps;
  SensorTime times{*world};
  subscribe_scanners(*world, config.body(),
                     [&](std::size_t i, const sensor_msgs::LaserScan& scan, const ScannerPlace& at) {
                       if (i != 0) return;
                       places.push_back(at);
                       stamps.push_back(times.of(i, scan, at));
                     });
  docent_msgs::Calibration said;
  said.mounts.push_back({"front", 0.2, 0.1, 0.5, 0.05, 0.0, 0.0, true});
  run(0.15);
  ASSERT_FALSE(places.empty());
  EXPECT_EQ(places.back().delay, 0.0);
  world->publisher(topics::kCalibration).publish(said);
  run(0.2);
  EXPECT_NEAR(places.back().base_from_sensor.x, 0.2, 1e-12);
  EXPECT_NEAR(to_seconds(hub.now() - stamps.back()), 0.05, 0.11);
  EXPECT_GE(to_seconds(hub.now() - stamps.back()), 0.05 - 1e-9);
}

}  // namespace
}  // namespace docent::modules::calibrate_module_test
