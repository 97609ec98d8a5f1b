#include "docent/modules/drive/tf_odometry.h"

#include <gtest/gtest.h>

namespace docent::modules {
namespace {

tf2_msgs::TFMessage transform_at(double time, double x, const std::string& child = "base_footprint") {
  return {{{{to_message(time_from_seconds(time)), "odom"}, child, {{x, 0.0, 0.0}, to_quaternion(Angle{})}}}};
}

TEST(TfOdometry, IsMadeOfTransformsWhereTheBaseTellsNothingElse) {
  TfOdometry odometry;
  int made = 0;
  for (int i = 0; i < 100; ++i) {
    const double time = 10.0 + 0.05 * i;
    const auto got = odometry.take(transform_at(time, 0.025 * i), time_from_seconds(time));
    EXPECT_FALSE(odometry.take(transform_at(time, 1.0, "laser"), time_from_seconds(time)));
    EXPECT_EQ(got.has_value(), i >= 40) << i;
    if (!got) continue;
    ++made;
    EXPECT_TRUE(odometry.hear(*got)) << "its own";
    EXPECT_NEAR(from_message(got->pose.pose).x, 0.025 * i, 1e-12);
    EXPECT_EQ(from_message(got->header.stamp), time_from_seconds(time));
    if (made > 1) {
      EXPECT_NEAR(got->twist.twist.linear.x, 0.5, 1e-6);
    }
  }
  EXPECT_TRUE(odometry.is_needed());
}

TEST(TfOdometry, WhoPublishesOdometryIsBelievedInThat) {
  TfOdometry odometry;
  for (int i = 0; i < 100; ++i) {
    const double time = 10.0 + 0.05 * i;
    EXPECT_FALSE(odometry.take(transform_at(time, 0.0), time_from_seconds(time)));
    nav_msgs::Odometry own;
    own.header.stamp = to_message(time_from_seconds(time));
    EXPECT_FALSE(odometry.hear(own));
  }
  EXPECT_FALSE(odometry.is_needed());
}

TEST(TfOdometry, StandsWhereThePoseStaysTheSame) {
  TfOdometry odometry;
  for (int i = 0; i < 100; ++i) {
    const double time = 10.0 + 0.05 * i;
    const auto got = odometry.take(transform_at(time, 3.0), time_from_seconds(time));
    if (got) {
      EXPECT_EQ(got->twist.twist.linear.x, 0.0);
    }
  }
}

}  // namespace
}  // namespace docent::modules
