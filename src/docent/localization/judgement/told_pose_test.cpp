#include "docent/localization/judgement/told_pose.h"

#include <gtest/gtest.h>

namespace docent::localization::told_pose_test {
namespace {

Pose2 at(double x) { return {x, 0.0, {}}; }

TEST(ToldPose, IsTheBestModeUntilAPlaceIsKnown) {
  ToldPose told;
  EXPECT_FALSE(told.tell({}, at(0.0), false));
  EXPECT_DOUBLE_EQ(told.tell(at(40.0), at(0.0), false)->x, 40.0);
  EXPECT_DOUBLE_EQ(told.tell(at(7.0), at(1.0), false)->x, 7.0);
  EXPECT_DOUBLE_EQ(told.tell(at(8.0), at(2.0), true)->x, 8.0);
}

TEST(ToldPose, OfALostRobotFollowsOdometryAndNotTheStrongestPeak) {
  ToldPose told;
  EXPECT_DOUBLE_EQ(told.tell(at(5.0), at(1.0), true)->x, 5.0);
  EXPECT_DOUBLE_EQ(told.tell(at(45.0), at(1.5), false)->x, 5.5);
  EXPECT_DOUBLE_EQ(told.tell({}, at(2.0), false)->x, 6.0) << "no mode at all";
  EXPECT_DOUBLE_EQ(told.tell(at(6.8), at(2.6), true)->x, 6.8) << "found again";
  EXPECT_DOUBLE_EQ(told.tell(at(45.0), at(3.0), false)->x, 7.2) << "from where it was found";
}

}  // namespace
}  // namespace docent::localization::told_pose_test
