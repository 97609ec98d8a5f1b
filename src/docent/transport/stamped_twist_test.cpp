#include "docent/transport/stamped_twist.h"

#include <gtest/gtest.h>

#include <chrono>

#include "docent/messages/conversions.h"
#include "docent/messages/standard_messages.h"

namespace docent::transport {
namespace {

TEST(StampedTwist, IsATwistStampedOnTheWire) {
  const TypeSupport& support = stamped_twist_support();
  EXPECT_STREQ(support.name, "geometry_msgs/msg/TwistStamped");
  const geometry_msgs::Twist twist{{0.4, 0.0, 0.0}, {0.0, 0.0, -0.2}};
  const auto bytes = support.encode(&twist);
  const auto stamped = decode_cdr<geometry_msgs::TwistStamped>(bytes);
  ASSERT_TRUE(stamped);
  EXPECT_EQ(stamped->header.frame_id, "base_link");
  EXPECT_EQ(stamped->twist.linear.x, 0.4);
  EXPECT_EQ(stamped->twist.angular.z, -0.2);
  const Duration wall = std::chrono::system_clock::now().time_since_epoch();
  EXPECT_NEAR(to_seconds(from_message(stamped->header.stamp)), to_seconds(wall), 5.0);
  const auto back = std::static_pointer_cast<const geometry_msgs::Twist>(support.decode(bytes));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->linear.x, 0.4);
  EXPECT_EQ(support.decode({}), nullptr);
}

}  // namespace
}  // namespace docent::transport
