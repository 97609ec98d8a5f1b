#include "docent/modules/shared/pose_tracker.h"

#include <gtest/gtest.h>

namespace docent::modules {
namespace {

TEST(PoseTracker, KnowsWhereTheBaseWasWhenAReadingWasTaken) {
  PoseTracker tracker;
  EXPECT_FALSE(tracker.odom_from_base_at({}));
  EXPECT_FALSE(tracker.map_from_base_at({}));
  for (int i = 0; i <= 40; ++i) {  // turning at 1.2 rad/s
    nav_msgs::Odometry odometry;
    odometry.header = {to_message(time_from_seconds(10.0 + 0.05 * i)), "odom"};
    odometry.pose.pose = to_message(Pose2{1.0, 2.0, Angle::radians(1.2 * 0.05 * i)});
    odometry.twist.twist.angular.z = 1.2;
    tracker.on_odometry(odometry);
  }
  EXPECT_FALSE(tracker.map_from_base_at(time_from_seconds(11.0))) << "no belief yet";
  docent_msgs::Belief belief;
  belief.localized = true;
  belief.hypotheses.push_back({4.0, 5.0, 0.5, {}, 0.9});
  belief.odom_pose = to_message(Pose2{1.0, 2.0, {}});
  tracker.on_belief(belief);
  EXPECT_NEAR(tracker.map_from_base()->theta.radians(), 0.5 + 2.4, 1e-9);
  for (const double age : {0.0, 0.1, 0.33, 1.0}) {
    const auto then = tracker.map_from_base_at(time_from_seconds(12.0 - age));
    ASSERT_TRUE(then);
    EXPECT_NEAR(then->theta.radians(), 0.5 + 1.2 * (2.0 - age), 1e-9) << age << " s ago";
    EXPECT_NEAR(then->x, 4.0, 1e-9);
  }
  EXPECT_NEAR(tracker.odom_from_base_at(time_from_seconds(12.1))->theta.radians(), 1.2 * 2.1, 1e-9) << "carried on";
}

TEST(PoseTracker, AJumpOfTheOdometryMovesNothing) {
  PoseTracker tracker;
  const auto tell = [&](double time, const Pose2& raw) {
    nav_msgs::Odometry odometry;
    odometry.header.stamp = to_message(time_from_seconds(time));
    odometry.pose.pose = to_message(raw);
    tracker.on_odometry(odometry);
  };
  for (int i = 0; i < 40; ++i) tell(10.0 + 0.05 * i, {1.0, 2.0, {}});
  docent_msgs::Belief belief;
  belief.localized = true;
  belief.header.stamp = to_message(time_from_seconds(11.9));
  belief.hypotheses.push_back({4.0, 5.0, 0.5, {}, 0.9});
  belief.odom_pose = to_message(Pose2{1.0, 2.0, {}});
  tracker.on_belief(belief);
  for (int i = 0; i < 10; ++i) tell(12.0 + 0.05 * i, {7.0, -3.0, Angle::degrees(80.0)});
  const auto expect_here = [&] {
    EXPECT_NEAR(tracker.map_from_base()->x, 4.0, 1e-9);
    EXPECT_NEAR(tracker.map_from_base()->theta.radians(), 0.5, 1e-9);
    EXPECT_NEAR(tracker.map_from_base_at(time_from_seconds(11.5))->x, 4.0, 1e-9);
    EXPECT_NEAR(tracker.map_from_base_at(time_from_seconds(12.3))->y, 5.0, 1e-9);
    // What is told in odometry's frame is in that of now.
    EXPECT_NEAR(tracker.odom_from_base()->x, 7.0, 1e-9);
    EXPECT_NEAR((*tracker.map_from_odom() * *tracker.odom_from_base()).x, 4.0, 1e-9);
    EXPECT_NEAR(tracker.odom_from_base_at(time_from_seconds(11.5))->x, 1.0, 1e-9);
  };
  expect_here();
  belief.header.stamp = to_message(time_from_seconds(12.2));
  belief.odom_pose = to_message(Pose2{7.0, -3.0, Angle::degrees(80.0)});
  tracker.on_belief(belief);
  expect_here();
}

}  // namespace
}  // namespace docent::modules
