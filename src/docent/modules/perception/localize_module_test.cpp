#include "docent/modules/perception/localize_module.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "docent/geometry/polygon.h"
#include "docent/modules/shared/module_bench.h"

namespace docent::modules::localize_module_test {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// A room of 6 x 4 m with a pillar near one corner: from nowhere in it does it look as from elsewhere.
class LocalizeModule : public ModuleBench {
 protected:
  LocalizeModule() : ModuleBench{"localize", make_localize} {
    for (const char* has_no : {"body.sonars=0", "body.infrareds=0"}) EXPECT_TRUE(config.set(has_no));
    museum.map = map_with(walls);
    museum.area = {{0, 0}, {6, 0}, {6, 4}, {0, 4}};
    keep(topics::kBelief, belief, beliefs);
    keep(topics::kPose, pose, poses);
    keep(topics::kPersonBeams, beams, sweeps);
    world->subscribe<tf2_msgs::TFMessage>(topics::kTransforms,
                                          [this](const auto& message) { map_from_odom = message.transforms.front(); });
    world->every(seconds(0.05), [this] { move(); });
    world->every(seconds(0.1), [this] { see(); });
  }

  static OccupancyGrid map_with(const std::vector<Segment>& walls) {
    OccupancyGrid map;
    map.frame = {140, 100, 0.05, {-0.5, -0.5}};
    map.cells.assign(map.frame.size(), 0);
    for (int row = 0; row < map.frame.rows; ++row) {
      for (int column = 0; column < map.frame.columns; ++column) {
        const Point2 at = map.frame.centre({column, row});
        const bool is_wall =
            std::any_of(walls.begin(), walls.end(), [&](const Segment& wall) { return distance(wall, at) < 0.06; });
        map.cells[map.frame.index({column, row})] = is_wall ? 100 : 0;
      }
    }
    return map;
  }

  /// Round in a circle of 1 m, as odometry has it too: from its own origin, in its own axes.
  void move() {
    if (drives) truth = truth * Pose2{0.02, 0.0, Angle::radians(0.02)};
    nav_msgs::Odometry odometry;
    odometry.header = {to_message(hub.now()), "odom"};
    odometry.pose.pose = to_message(odom_from_map * truth);
    odometry.twist.twist.linear.x = 0.4;
    odometry.twist.twist.angular.z = 0.4;
    if (has_odometry) odometries.publish(odometry);
  }
  void see() {
    for (const bool front : {true, false}) {
      if (!(front ? has_front : has_rear)) continue;
      sensor_msgs::LaserScan scan;
      scan.header = {to_message(hub.now() - seconds(front ? 0.0 : rear_late)), front ? "laser_front" : "laser_rear"};
      scan.angle_min = static_cast<float>(-90.0 * kDegree);
      scan.angle_increment = static_cast<float>(2.0 * kDegree);
      scan.range_max = 10.0F;
      for (int i = 0; i <= 90; ++i) {
        const Angle bearing = truth.theta + Angle::degrees(2.0 * i - 90.0 + (front ? 0.0 : 180.0));
        double range = 10.0;
        for (const Segment& wall : walls)
          if (const auto hit = ray_distance(truth.position(), unit(bearing), wall)) range = std::min(range, *hit);
        scan.ranges.push_back(static_cast<float>(range));
      }
      (front ? fronts : rears).publish(scan);
    }
  }
  /// The rear scanner does, for good: it is silent as long, once.
  void come_later(double by) {
    has_rear = false;
    run(by);
    has_rear = true;
    rear_late += by;
  }
  /// [m] of the best hypothesis from the truth.
  [[nodiscard]] double error() const {
    const auto& best = belief.hypotheses.at(0);
    return distance(Point2{best.x, best.y}, truth.position());
  }

  std::vector<Segment> walls = [] {
    auto all = sides({{0, 0}, {6, 0}, {6, 4}, {0, 4}});
    for (const Segment& side : sides({{4.5, 0.8}, {5.2, 0.8}, {5.2, 1.1}, {4.5, 1.1}})) all.push_back(side);
    return all;
  }();
  Pose2 truth{2.0, 1.0, Angle{}};
  Pose2 odom_from_map{7.0, -3.0, Angle::degrees(50.0)};
  bool drives = true, has_odometry = true, has_front = true, has_rear = true;
  double rear_late = 0.0;  // [s]
  transport::Publisher<nav_msgs::Odometry> odometries = world->publisher(topics::kOdometry);
  transport::Publisher<sensor_msgs::LaserScan> fronts = world->publisher(topics::kScanFront);
  transport::Publisher<sensor_msgs::LaserScan> rears = world->publisher(topics::kScanRear);
  docent_msgs::Belief belief;
  geometry_msgs::PoseWithCovarianceStamped pose;
  docent_msgs::PersonBeams beams;
  std::optional<geometry_msgs::TransformStamped> map_from_odom;
  int beliefs = 0, poses = 0, sweeps = 0;
};

TEST_F(LocalizeModule, SaysAPoseAndAFrameOnlyWhenItKnowsThem) {
  start();
  run(0.01);
  ASSERT_GE(beliefs, 1) << "the belief is said at once";
  EXPECT_FALSE(belief.localized);
  EXPECT_EQ(belief.map_hash, map_hash(museum.map));
  EXPECT_EQ(belief.header.frame_id, "map");
  bool was_sure_too_early = false;
  for (int i = 0; i < 600 && !belief.localized; ++i) {
    run(0.1);
    was_sure_too_early = was_sure_too_early || (!belief.localized && (poses > 0 || map_from_odom));
  }
  EXPECT_FALSE(was_sure_too_early);
  ASSERT_TRUE(belief.localized);
  run(1.0);
  EXPECT_LT(error(), 0.15);
  ASSERT_GT(poses, 0);
  EXPECT_EQ(pose.header.frame_id, "map");
  ASSERT_TRUE(map_from_odom);
  EXPECT_EQ(map_from_odom->header.frame_id, "map");
  EXPECT_EQ(map_from_odom->child_frame_id, "odom");
  const Pose2 wanted = inverse(odom_from_map);
  EXPECT_NEAR(map_from_odom->transform.translation.x, wanted.x, 0.4);  // 8 m away a degree is 13 cm
  EXPECT_NEAR(map_from_odom->transform.translation.y, wanted.y, 0.4);
  EXPECT_NEAR((yaw_of(map_from_odom->transform.rotation) - wanted.theta).degrees(), 0.0, 3.0);
  EXPECT_EQ(module->health().state, "ready");
}

TEST_F(LocalizeModule, WithoutOdometryOrAScannerItSaysSo) {
  has_odometry = false;
  start();
  run(2.0);
  EXPECT_EQ(module->health().reason, "no odom");
  EXPECT_EQ(sweeps, 0) << "a sweep that nobody can place is none";
  EXPECT_EQ(beliefs, 1);
  has_odometry = true;
  has_rear = false;
  run(2.0);
  EXPECT_EQ(module->health().reason, "no scan_rear");
  EXPECT_GE(sweeps, 9) << "the other one counts, once every two of its scans";
  EXPECT_EQ(beams.bearings.size(), 91U);
  has_rear = true;
  run(0.2);
  EXPECT_NE(module->health().reason, "no scan_rear");
}

TEST_F(LocalizeModule, ScansOfAboutOneTimeMakeOneSweepAndALateOneIsLeftOut) {
  start();
  run(1.0);
  EXPECT_EQ(beams.bearings.size(), 2U * 91U);
  EXPECT_EQ(beams.header.frame_id, "base_link");
  come_later(0.2);
  run(1.0);
  EXPECT_EQ(beams.bearings.size(), 2U * 91U);
  EXPECT_LT(to_seconds(hub.now() - from_message(beams.header.stamp)), 0.15) << "the stamp of the newer";
  come_later(0.2);
  run(1.0);
  EXPECT_EQ(beams.bearings.size(), 2U * 91U) << "so late a laser may be all day";
  come_later(0.2);
  run(1.0);
  EXPECT_EQ(beams.bearings.size(), 91U);
}

TEST_F(LocalizeModule, WhatIsKnownOfLateStampsIsNotTakenForAClockOfItsOwn) {
  start();
  docent_msgs::Calibration calibration;
  constexpr double kLate = 0.2;  // [s]: more than the way of an honest message
  calibration.mounts.push_back({"front", 0.0, 0.0, 0.0, kLate, 0.0, 0.0, true});
  calibration.mounts.push_back({"rear", 0.0, 0.0, std::numbers::pi, kLate, 0.0, 0.0, true});
  world->publisher(topics::kCalibration).publish(calibration);
  run(5.0);
  EXPECT_NEAR(to_seconds(hub.now() - from_message(belief.header.stamp)), kLate + 0.1, 0.11);
  EXPECT_GE(to_seconds(hub.now() - from_message(belief.header.stamp)), kLate - 1e-6);
}

TEST_F(LocalizeModule, ANewProcessGoesOnWhereTheOldOneWasInTheSameMap) {
  start();
  for (int i = 0; i < 600 && !belief.localized; ++i) run(0.1);
  ASSERT_TRUE(belief.localized);
  run(2.0);
  drives = false;
  run(1.0);
  start();
  run(0.3);
  EXPECT_GT(belief.hypotheses.at(0).mass, 0.5);
  EXPECT_LT(error(), 0.3) << "at once";
  kill();
  run(61.0);
  start();
  run(0.01);
  EXPECT_TRUE(belief.hypotheses.empty() || belief.hypotheses[0].mass < 0.5) << "a minute later it may be elsewhere";
}

TEST_F(LocalizeModule, ACheckpointOfAnotherMapIsNotUsed) {
  start();
  run(0.01);
  const double knows_nothing = belief.entropy;
  for (int i = 0; i < 600 && !belief.localized; ++i) run(0.1);
  ASSERT_TRUE(belief.localized);
  run(2.0);
  ASSERT_LT(belief.entropy, 0.8 * knows_nothing);
  drives = false;
  kill();
  museum.map.cells[museum.map.frame.index({60, 60})] = 100;
  start();
  run(0.01);
  EXPECT_GT(belief.entropy, 0.8 * knows_nothing);
}

}  // namespace
}  // namespace docent::modules::localize_module_test
