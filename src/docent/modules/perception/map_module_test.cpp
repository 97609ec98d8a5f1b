#include "docent/modules/perception/map_module.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "docent/geometry/polygon.h"
#include "docent/mapping/occupancy/live_map.h"
#include "docent/messages/conversions.h"
#include "docent/transport/virtual_time_bus.h"

namespace docent::modules::map_module_test {
namespace {

constexpr double kHalf = 4.0;         // [m] of the square room
constexpr double kResolution = 0.05;  // [m]
constexpr double kTurnRate = 1.2;     // [rad/s] of the robot in its middle
constexpr double kDegree = std::numbers::pi / 180.0;

OccupancyGrid room() {
  OccupancyGrid map;
  map.frame = {180, 180, kResolution, {-kHalf - 0.5, -kHalf - 0.5}};
  map.cells.assign(map.frame.size(), 0);
  for (int row = 0; row < 180; ++row) {
    for (int column = 0; column < 180; ++column) {
      const Point2 centre = map.frame.centre({column, row});
      if (std::max(std::abs(centre.x), std::abs(centre.y)) > kHalf) map.cells[map.frame.index({column, row})] = 100;
    }
  }
  return map;
}

/// The live map of an empty room in which the robot turns on the spot; a post may stand in it.
class LiveMapOfARoom : public ::testing::Test {
 protected:
  LiveMapOfARoom() {
    museum.map = room();
    auto made = make_map({*map_bus, museum, config, "", 1, true});
    EXPECT_TRUE(made);
    map = std::move(*made);
    world->subscribe<docent_msgs::LiveMapUpdate>(topics::kLiveMapUpdate, [this](const auto& update) { count(update); });
    world->every(seconds(0.05), [this] { tick(); });
  }

  [[nodiscard]] Pose2 pose_at(Time time) const { return {0.0, 0.0, Angle::radians(kTurnRate * to_seconds(time))}; }

  void tick() {
    const Time now = world->now();
    if (now < time_from_seconds(0.2)) return;  // a stamp of zero is none
    nav_msgs::Odometry odometry;
    odometry.header = {to_message(now), "odom"};
    odometry.pose.pose = to_message(pose_at(now));
    odometry.twist.twist.angular.z = kTurnRate;
    odometry_publisher.publish(odometry);
    docent_msgs::Belief belief;
    belief.header = {to_message(now), "map"};
    belief.localized = true;
    belief.hypotheses.push_back({0.0, 0.0, pose_at(now).theta.radians(), {}, 1.0});
    belief.odom_pose = to_message(pose_at(now));
    belief_publisher.publish(belief);
    sensor_msgs::LaserScan scan;
    const Time taken = now - seconds(0.1);  // it has been under way for so long
    scan.header = {to_message(taken), "laser_front"};
    scan.angle_min = static_cast<float>(-90.0 * kDegree);
    scan.angle_increment = static_cast<float>(kDegree);
    scan.range_max = 10.0F;
    for (int i = 0; i <= 180; ++i) {
      const Point2 ahead = unit(pose_at(taken).theta + Angle::degrees(i - 90.0));
      double range = 10.0;
      for (const auto& wall : walls)
        if (const auto hit = ray_distance({}, ahead, wall)) range = std::min(range, *hit);
      if (const auto hit = has_post ? ray_distance({}, ahead, {2.0, 0.0}, 0.2) : std::nullopt)
        range = std::min(range, *hit);
      scan.ranges.push_back(static_cast<float>(range));
    }
    scan_publisher.publish(scan);
  }

  void count(const docent_msgs::LiveMapUpdate& update) {
    std::size_t k = 0;
    const double cell = kResolution * mapping::LiveMapParams{}.coarsening;
    for (std::uint32_t row = 0; row < update.height; ++row) {
      for (std::uint32_t column = 0; column < update.width; ++column, ++k) {
        const Point2 centre{-kHalf - 0.5 + (update.x + column + 0.5) * cell,
                            -kHalf - 0.5 + (update.y + row + 0.5) * cell};
        if (update.data[k] < 65 || std::max(std::abs(centre.x), std::abs(centre.y)) > kHalf - 0.25) continue;
        (distance(centre, {2.0, 0.0}) < 0.45 ? post_cells : ghost_cells) += 1;
      }
    }
  }

  transport::VirtualTimeHub hub;
  museum::Museum museum;
  robot::RobotConfig config;
  std::unique_ptr<transport::Bus> world = hub.connect("world");
  std::unique_ptr<transport::Bus> map_bus = hub.connect("map");
  transport::Publisher<nav_msgs::Odometry> odometry_publisher = world->publisher(topics::kOdometry);
  transport::Publisher<docent_msgs::Belief> belief_publisher = world->publisher(topics::kBelief);
  transport::Publisher<sensor_msgs::LaserScan> scan_publisher = world->publisher(topics::kScanFront);
  std::vector<Segment> walls = sides({{-kHalf, -kHalf}, {kHalf, -kHalf}, {kHalf, kHalf}, {-kHalf, kHalf}});
  bool has_post = false;
  int post_cells = 0;
  int ghost_cells = 0;
  std::unique_ptr<Module> map;
};

TEST_F(LiveMapOfARoom, ATurningRobotSeesNoGhosts) {
  hub.run_until(time_from_seconds(20.0));
  EXPECT_EQ(ghost_cells, 0);
  EXPECT_EQ(post_cells, 0);
}

TEST_F(LiveMapOfARoom, WhatStandsThereIsSeenWhereItStands) {
  has_post = true;
  hub.run_until(time_from_seconds(20.0));
  EXPECT_GT(post_cells, 0);
  EXPECT_EQ(ghost_cells, 0);
}

}  // namespace
}  // namespace docent::modules::map_module_test
