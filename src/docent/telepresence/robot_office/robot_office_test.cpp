#include "docent/telepresence/robot_office/robot_office.h"

#include <gtest/gtest.h>

#include <limits>

#include "docent/telepresence/client_message.h"

namespace docent::telepresence {
namespace {

constexpr const char* kGoal = "01900000-0000-7000-8000-000000000001";

TEST(RobotGoal, WhatIsNoPlaceIsNone) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(fault_of(documents::RobotGoal{kGoal, 1.0, 2.0, 3.0}), "");
  EXPECT_EQ(fault_of(documents::RobotGoal{"goal", 1.0, 2.0, 3.0}), "id must be a UUID of version 7");
  EXPECT_EQ(fault_of(documents::RobotGoal{kGoal, nan, 2.0, 3.0}), "x, y is no place");
  EXPECT_EQ(fault_of(documents::RobotGoal{kGoal, 1.0, 1e5, 3.0}), "x, y is no place");
  EXPECT_EQ(fault_of(documents::RobotGoal{kGoal, 1.0, 2.0, nan}), "heading is no angle");
}

TEST(OfficeWish, WhatIsNoOrderIsNone) {
  EXPECT_EQ(fault_of(documents::OfficeWish{kGoal, "deliver", "kitchen"}), "");
  EXPECT_EQ(fault_of(documents::OfficeWish{kGoal, "tidy", ""}), "");
  EXPECT_EQ(fault_of(documents::OfficeWish{kGoal, "deliver", ""}), "a delivery needs a room");
  EXPECT_EQ(fault_of(documents::OfficeWish{kGoal, "sing", ""}), "kind must be deliver, tidy, confirm or stop");
  EXPECT_EQ(fault_of(documents::OfficeWish{"1", "tidy", ""}), "id must be a UUID of version 7");
  EXPECT_EQ(fault_of(documents::OfficeWish{kGoal, "tidy", std::string(65, 'x')}), "room is no room's id");
}

TEST(RobotGoal, ItsWithdrawalHasAnIdOfItsOwnThatIsAlwaysTheSame) {
  const std::string id = withdrawal_id(kGoal);
  EXPECT_TRUE(is_uuid7(id)) << id;
  EXPECT_NE(id, kGoal);
  EXPECT_EQ(id, withdrawal_id(kGoal));
}

}  // namespace
}  // namespace docent::telepresence
