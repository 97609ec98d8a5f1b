#include "docent/recording/rosbag/frame_tree.h"

#include <gtest/gtest.h>

#include <cmath>

#include "docent/messages/conversions.h"

namespace docent::recording {
namespace {

geometry_msgs::TransformStamped link(const std::string& parent, const std::string& child, double x, double degrees) {
  geometry_msgs::TransformStamped transform;
  transform.header.frame_id = parent;
  transform.child_frame_id = child;
  transform.transform.translation = {x, 0.0, 0.2};
  transform.transform.rotation = to_quaternion(Angle::degrees(degrees));
  return transform;
}

TEST(FrameTree, AChainLeadsToTheBase) {
  FrameTree frames;
  frames.add_static(link("/robot1/base_link", "robot1/mast", 0.1, 90));
  frames.add_static(link("robot1/mast", "robot1/laser", 0.2, 90));
  const auto mount = frames.mount_of("robot1/laser", "robot1/base_footprint");
  ASSERT_TRUE(mount);
  EXPECT_NEAR(mount->base_from_sensor.x, 0.1, 1e-9);
  EXPECT_NEAR(mount->base_from_sensor.y, 0.2, 1e-9);
  EXPECT_NEAR(std::abs(mount->base_from_sensor.theta.degrees()), 180.0, 1e-6);
  EXPECT_FALSE(mount->is_upside_down);
  EXPECT_FALSE(frames.mount_of("robot1/camera", "robot1/base_link"));
}

TEST(FrameTree, WhatIsSaidAgainAndAgainCountsWhereNothingElseDoes) {
  FrameTree frames;
  frames.add_moving(link("base_link", "laser", 0.3, 0));
  ASSERT_TRUE(frames.mount_of("laser", ""));
  EXPECT_NEAR(frames.mount_of("laser", "")->base_from_sensor.x, 0.3, 1e-9);
  frames.add_static(link("base_link", "laser", 0.1, 0));
  EXPECT_NEAR(frames.mount_of("laser", "")->base_from_sensor.x, 0.1, 1e-9);
}

TEST(FrameTree, RingsAndPlacesFarOffAreNone) {
  FrameTree frames;
  frames.add_static(link("b", "a", 0.1, 0));
  frames.add_static(link("a", "b", 0.1, 0));
  frames.add_static(link("base_link", "far", 50.0, 0));
  EXPECT_FALSE(frames.mount_of("a", "base_link"));
  EXPECT_FALSE(frames.mount_of("far", "base_link"));
}

TEST(FrameTree, OdometryIsTold) {
  EXPECT_TRUE(tells_odometry(link("odom", "base_link", 0, 0)));
  EXPECT_TRUE(tells_odometry(link("/robot1/odom", "robot1/base_footprint", 0, 0)));
  EXPECT_FALSE(tells_odometry(link("map", "odom", 0, 0)));
  EXPECT_TRUE(tells_odometry(link("odom_combined", "chassis", 0, 0))) << "whatever the robot is called";
  EXPECT_FALSE(tells_odometry(link("odom", "map", 0, 0)));
  EXPECT_FALSE(tells_odometry(link("base_link", "laser", 0, 0)));
}

TEST(FrameTree, TheBaseOfOdometryCountsWhicheverHangsOnTheOther) {
  for (const bool is_above : {true, false}) {
    FrameTree frames;
    frames.add_static(is_above ? link("base_footprint", "base_link", 0.2, 180)
                               : link("base_link", "base_footprint", 0.2, 180));
    frames.add_static(link("base_link", "laser", 0.1, 0));
    const auto mount = frames.mount_of("laser", "base_footprint");
    ASSERT_TRUE(mount);
    EXPECT_NEAR(mount->base_from_sensor.x, 0.1, 1e-9) << "0.2 ahead, turned round, 0.1 back";
    EXPECT_NEAR(std::abs(mount->base_from_sensor.theta.degrees()), 180.0, 1e-6);
    EXPECT_NEAR(frames.mount_of("laser", "chassis")->base_from_sensor.x, 0.1, 1e-9) << "else what is called so";
  }
}

TEST(FrameTree, WhatMovesOrIsTiltedShows) {
  FrameTree frames;
  frames.add_moving(link("base_link", "laser", 0.1, 0));
  frames.add_moving(link("base_link", "laser", 0.1, 0.1));
  EXPECT_FALSE(frames.mount_of("laser", "")->moves);
  frames.add_moving(link("base_link", "laser", 0.1, 5));
  EXPECT_TRUE(frames.mount_of("laser", "")->moves);
  auto tilted = link("base_link", "camera", 0.1, 0);
  tilted.transform.rotation = {0.0, std::sin(0.25), 0.0, std::cos(0.25)};
  frames.add_static(tilted);
  EXPECT_NEAR(frames.mount_of("camera", "")->tilt, 0.5, 1e-9);
  EXPECT_NEAR(frames.mount_of("laser", "")->tilt, 0.0, 1e-6);
}

TEST(FrameTree, WhatOthersSayFillsGaps) {
  FrameTree own, all;
  own.add_static(link("mast", "laser", 0.1, 0));
  all.add_static(link("base_link", "mast", 0.2, 0));
  all.add_static(link("mast", "laser", 5.0, 0));
  EXPECT_FALSE(own.mount_of("laser", "base_link"));
  own.add(all);
  EXPECT_NEAR(own.mount_of("laser", "base_link")->base_from_sensor.x, 0.3, 1e-9);
}

}  // namespace
}  // namespace docent::recording
