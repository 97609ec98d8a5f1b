#include "docent/telepresence/belief_carrier.h"

#include <gtest/gtest.h>

#include <numbers>

#include "docent/messages/conversions.h"

namespace docent::telepresence {
namespace {

nav_msgs::Odometry odometry(double time, const Pose2& odom_from_base) {
  nav_msgs::Odometry message;
  message.header.stamp = to_message(time_from_seconds(time));
  message.pose.pose = to_message(odom_from_base);
  message.twist.twist.linear.x = 0.5;
  return message;
}

docent_msgs::Belief belief(double time, const Pose2& map_from_base, const Pose2& odom_from_base, bool localized) {
  docent_msgs::Belief message;
  message.header.stamp = to_message(time_from_seconds(time));
  message.hypotheses.resize(2);
  message.hypotheses[0].x = map_from_base.x;
  message.hypotheses[0].y = map_from_base.y;
  message.hypotheses[0].theta = map_from_base.theta.radians();
  message.hypotheses[0].mass = 0.9;
  message.hypotheses[1].mass = 0.01;
  message.odom_pose = to_message(odom_from_base);
  message.localized = localized;
  message.p_lost = 0.1;
  return message;
}

TEST(BeliefCarrier, KnowsNothingAtFirst) {
  BeliefCarrier carrier;
  EXPECT_FALSE(carrier.map_from_base(Time{}));
  EXPECT_TRUE(carrier.hypotheses(Time{}, 0.0).empty());
  carrier.set_belief(belief(0, {1, 2, Angle{}}, {}, true));
  EXPECT_FALSE(carrier.map_from_base(Time{}));  // no odometry
}

TEST(BeliefCarrier, CarriesTheBeliefForward) {
  BeliefCarrier carrier;
  // Odometry drives along its x axis, but the robot looks along the map's y axis.
  for (int i = 0; i <= 10; ++i) carrier.add_odometry(odometry(0.1 * i, {0.05 * i, 0.0, Angle{}}));
  carrier.set_belief(belief(0.4, {3, 4, Angle::radians(std::numbers::pi / 2)}, {0.2, 0.0, Angle{}}, true));
  const auto pose = carrier.map_from_base(time_from_seconds(1.0));
  ASSERT_TRUE(pose);
  EXPECT_NEAR(pose->x, 3.0, 1e-9);
  EXPECT_NEAR(pose->y, 4.3, 1e-9);
  const auto between = carrier.map_from_base(time_from_seconds(0.65));
  ASSERT_TRUE(between);
  EXPECT_NEAR(between->y, 4.125, 1e-9);
  EXPECT_NEAR(carrier.map_from_base(time_from_seconds(99))->y, 4.3, 1e-9);
  EXPECT_NEAR(carrier.map_from_base(time_from_seconds(-9))->y, 3.8, 1e-9);
  EXPECT_EQ(carrier.hypotheses(time_from_seconds(1), 0.05).size(), 1U);
  EXPECT_EQ(carrier.hypotheses(time_from_seconds(1), 0.0).size(), 2U);
}

TEST(BeliefCarrier, SaysItDoesNotKnow) {
  BeliefCarrier carrier;
  carrier.add_odometry(odometry(0, {}));
  carrier.set_belief(belief(0, {3, 4, Angle{}}, {}, false));
  EXPECT_FALSE(carrier.map_from_base(Time{}));
  EXPECT_EQ(carrier.hypotheses(Time{}, 0.05).size(), 1U);
}

TEST(BeliefCarrier, TurnsTheShortWayRound) {
  BeliefCarrier carrier;
  carrier.add_odometry(odometry(0, {0, 0, Angle::degrees(170)}));
  carrier.add_odometry(odometry(1, {0, 0, Angle::degrees(-170)}));
  carrier.set_belief(belief(0, {0, 0, Angle::degrees(170)}, {0, 0, Angle::degrees(170)}, true));
  EXPECT_NEAR(std::abs(carrier.map_from_base(time_from_seconds(0.5))->theta.degrees()), 180.0, 1e-6);
}

TEST(BeliefCarrier, FollowsADriverThatBeganAnew) {
  BeliefCarrier carrier;
  carrier.add_odometry(odometry(100, {5, 5, Angle{}}));
  carrier.add_odometry(odometry(1, {0, 0, Angle{}}));
  carrier.set_belief(belief(1, {1, 1, Angle{}}, {0, 0, Angle{}}, true));
  EXPECT_NEAR(carrier.map_from_base(time_from_seconds(1))->x, 1.0, 1e-9);
}

}  // namespace
}  // namespace docent::telepresence
