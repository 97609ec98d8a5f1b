#include "docent/modules/drive/robot_module.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <set>
#include <vector>

#include "docent/modules/shared/module_bench.h"

namespace docent::modules {
namespace {

class RobotModule : public ModuleBench {
 protected:
  RobotModule() : ModuleBench{"robot", make_robot} {
    say_stop(0, false);
    world->subscribe<geometry_msgs::Twist>(topics::kCommandVelocity, [this](const auto& twist) {
      commands.push_back({now_s(), twist.linear.x, twist.angular.z});
    });
  }
  /// As another keeper of the stop button says, to all who start, too.
  void say_stop(std::uint64_t number, bool is_stopped) {
    keeper.publish({{}, is_stopped, "ada", number, true, "avoid"});
  }
  transport::Publisher<docent_msgs::Stop> keeper = world->publisher(topics::kStop);
  struct Command {
    double at, linear, angular;
  };
  std::vector<Command> commands;
  transport::Publisher<docent_msgs::Drive> drive = world->publisher(topics::kDrive);
  transport::Publisher<nav_msgs::Odometry> odometry = world->publisher(topics::kOdometry);
  transport::Publisher<sensor_msgs::BatteryState> battery = world->publisher(topics::kBattery);
};

TEST_F(RobotModule, PassesACommandOnAtOnceThenRepeatsItWhileItIsFresh) {
  start();
  run(1.0);
  EXPECT_EQ(commands.size(), 20U) << "at 20 Hz, with or without a command";
  EXPECT_TRUE(std::all_of(commands.begin(), commands.end(),
                          [](const Command& command) { return command.linear == 0.0 && command.angular == 0.0; }));
  run(0.013);
  commands.clear();
  drive.publish({{}, 0.4, -0.2});
  run(0.001);
  ASSERT_EQ(commands.size(), 1U);
  EXPECT_NEAR(commands[0].at, 1.013, 1e-9);
  EXPECT_EQ(commands[0].linear, 0.4);
  EXPECT_EQ(commands[0].angular, -0.2);
  run(1.0);
  for (const Command& command : commands)
    EXPECT_EQ(command.linear, command.at <= 1.013 + 0.3 + 1e-9 ? 0.4 : 0.0) << command.at;
}

TEST_F(RobotModule, WhatTheBaseSaysOtherwiseOfAMountIsNamed) {
  const auto base = world->publisher(topics::kStaticTransforms);
  start();
  odometry.publish({});
  base.publish({{{{{}, "base_link"}, "laser_front", {{0.01, 0.0, 0.3}, {}}}}});
  run(0.1);
  EXPECT_EQ(module->health().reason, "") << "a centimetre is none, and how high it is does not matter";
  base.publish({{{{{}, "base_link"}, "laser_front", {{0.3, 0.0, 0.3}, {}}}}});
  run(0.1);
  EXPECT_EQ(module->health().state, "ready") << "what robot.yaml says counts";
  EXPECT_NE(module->health().reason.find("/tf_static has scanner front at x 0.300"), std::string::npos)
      << module->health().reason;
}

TEST_F(RobotModule, ASecondProgramThatCommandsTheBaseIsNamed) {
  start();
  odometry.publish({});
  run(0.6);
  EXPECT_EQ(module->health().state, "ready") << "it is alone";
  const auto joystick = world->publisher(topics::kCommandVelocity);
  joystick.publish({});
  odometry.publish({});
  run(0.5);
  EXPECT_EQ(module->health().state, "degraded");
  EXPECT_NE(module->health().reason.find("another program"), std::string::npos) << module->health().reason;
}

TEST_F(RobotModule, TheBodysLimitsHoldWhateverIsWanted) {
  ASSERT_TRUE(config.set("body.max_speed=0.5"));
  ASSERT_TRUE(config.set("body.max_turn_rate=0.7"));
  ASSERT_TRUE(config.set("robot.rate=5"));
  start();
  drive.publish({{}, 3.0, -3.0});
  run(0.01);
  ASSERT_EQ(commands.size(), 1U);
  EXPECT_EQ(commands[0].linear, 0.5);
  EXPECT_EQ(commands[0].angular, -0.7);
  run(1.0);
  EXPECT_EQ(commands.size(), 1U + 5U) << "5 Hz are asked for";
}

TEST_F(RobotModule, ANewProcessObeysNoCommandOfTheOldOnesTime) {
  start();
  drive.publish({{}, 0.4, 0.0});
  run(0.06);
  ASSERT_EQ(commands.back().linear, 0.4);
  start();
  commands.clear();
  run(0.2);  // the command would still be fresh
  ASSERT_FALSE(commands.empty());
  for (const Command& command : commands) EXPECT_EQ(command.linear, 0.0);
}

TEST_F(RobotModule, StandsWhileItIsStoppedWhateverIsCommanded) {
  start();
  world->every(seconds(0.1), [this] { drive.publish({{}, 0.4, 0.0}); });
  run(1.0);
  EXPECT_EQ(commands.back().linear, 0.4);
  say_stop(1, true);
  run(0.001);
  EXPECT_EQ(commands.back().linear, 0.0) << "at once";
  commands.clear();
  start();  // killed
  run(5.0);
  for (const Command& command : commands) EXPECT_EQ(command.linear, 0.0);
  say_stop(2, false);
  run(0.2);
  EXPECT_EQ(commands.back().linear, 0.4);
}

TEST_F(RobotModule, PublishesEveryMountForThoseWhoComeLateAndTheBaseAsOdometryHasIt) {
  ASSERT_TRUE(config.set("body.infrareds=2"));
  start();
  run(5.0);
  std::set<std::string> frames;
  double second_sonar = 0.0;
  const auto late = hub.connect("late");
  late->subscribe<tf2_msgs::TFMessage>(topics::kStaticTransforms, [&](const auto& mounts) {
    for (const auto& mount : mounts.transforms) {
      EXPECT_EQ(mount.header.frame_id, "base_link");
      frames.insert(mount.child_frame_id);
      if (mount.child_frame_id == robot::RobotBody::sonar_frame(1))
        second_sonar = yaw_of(mount.transform.rotation).degrees();
    }
  });
  geometry_msgs::TransformStamped base;
  world->subscribe<tf2_msgs::TFMessage>(topics::kTransforms,
                                        [&](const auto& message) { base = message.transforms.front(); });
  nav_msgs::Odometry moved;
  moved.header = {to_message(time_from_seconds(4.25)), "odom"};
  moved.pose.pose = to_message(Pose2{1.0, -2.0, Angle::degrees(90.0)});
  odometry.publish(moved);
  run(0.1);
  EXPECT_EQ(frames.size(), 2U + 24U + 2U);
  EXPECT_TRUE(frames.contains("laser_front") && frames.contains("laser_rear"));
  EXPECT_TRUE(frames.contains(robot::RobotBody::infrared_frame(1)));
  EXPECT_NEAR(second_sonar, 15.0, 1e-6);
  EXPECT_EQ(base.header.frame_id, "odom");
  EXPECT_EQ(base.child_frame_id, "base_link");
  EXPECT_EQ(from_message(base.header.stamp), time_from_seconds(4.25)) << "of the reading, not of its arrival";
  EXPECT_EQ(base.transform.translation.y, -2.0);
}

TEST_F(RobotModule, AScannerThatHangsIsTurnedOverForThoseWhoReadItsMount) {
  ASSERT_TRUE(config.set("body.scanners=[{heading: 45, upside_down: true}]"));
  start();
  run(1.0);
  geometry_msgs::Quaternion hung;
  const auto late = hub.connect("late");
  late->subscribe<tf2_msgs::TFMessage>(
      topics::kStaticTransforms, [&](const auto& mounts) { hung = mounts.transforms.front().transform.rotation; });
  run(0.1);
  EXPECT_NEAR(yaw_of(hung).degrees(), 45.0, 1e-6) << "it looks there still, and";
  EXPECT_NEAR(1.0 - 2.0 * (hung.x * hung.x + hung.y * hung.y), -1.0, 1e-9) << "its axis points to the floor";
}

TEST_F(RobotModule, SaysWhenTheBaseIsSilentOrItsBatteryLow) {
  start();
  EXPECT_EQ(module->health().state, "starting");
  run(5.0);
  EXPECT_EQ(module->health().state, "starting") << "no base has spoken yet";
  odometry.publish({});
  run(0.9);
  EXPECT_EQ(module->health().state, "ready");
  run(0.2);
  EXPECT_EQ(module->health().reason, "no fresh odometry from the base");
  sensor_msgs::BatteryState charge;
  for (const float share : {0.14F, 0.16F}) {
    charge.percentage = share;
    battery.publish(charge);
    odometry.publish({});
    run(0.1);
    EXPECT_EQ(module->health().reason, share < 0.15F ? "the battery is low" : "");
  }
}

TEST_F(RobotModule, TakesOdometryFromTheTransformsOfABaseThatPublishesNone) {
  std::vector<nav_msgs::Odometry> heard;
  world->subscribe<nav_msgs::Odometry>(topics::kOdometry, [&](const auto& one) { heard.push_back(one); });
  int transforms_heard = 0;
  world->subscribe<tf2_msgs::TFMessage>(topics::kTransforms, [&](const auto&) { ++transforms_heard; });
  const auto transforms = world->publisher(topics::kTransforms);
  start();
  double x = 0.0;
  int told = 0;
  world->every(seconds(0.05), [&] {
    x += 0.01;
    ++told;
    transforms.publish({{{{to_message(world->now()), "odom"}, "base_link", {{x, 0.0, 0.0}, to_quaternion(Angle{})}}}});
  });
  run(5.0);
  EXPECT_NEAR(static_cast<double>(heard.size()), 60.0, 3.0) << "after a patience of 2 s";
  EXPECT_NEAR(heard.back().twist.twist.linear.x, 0.2, 1e-6);
  EXPECT_LE(transforms_heard, told) << "none is published twice";
  EXPECT_EQ(module->health().state, "ready");
  EXPECT_NE(module->health().reason.find("transform"), std::string::npos);
}

}  // namespace
}  // namespace docent::modules
