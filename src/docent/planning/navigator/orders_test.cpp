#include "docent/planning/navigator/orders.h"

#include <gtest/gtest.h>

namespace docent::planning::orders_test {
namespace {

const PursuitGoal kGoal{"g", {9.0, 6.0, {}}, 0.4, 0.2};
/// Odometry's origin at (3, 6) of the map, its x axis along the map's y axis turned back.
const Pose2 kMapFromOdom{3.0, 6.0, Angle::degrees(-90)};

TEST(AimOf, PutsAPursuitIntoOdometrysFrame) {
  Pursuit pursuit;
  pursuit.mode = DriveMode::drive;
  pursuit.via = {{4.0, 6.0}, {4.0, 7.0}};
  pursuit.is_final = true;
  pursuit.heading = Angle::degrees(10);
  const Aim aim = aim_of(pursuit, kGoal, kMapFromOdom);
  EXPECT_EQ(aim.mode, DriveMode::drive);
  EXPECT_TRUE(aim.is_final);
  EXPECT_NEAR(aim.heading.degrees(), 100.0, 1e-9);
  ASSERT_EQ(aim.via.size(), 2U);
  EXPECT_NEAR(aim.via[0].x, 0.0, 1e-9);
  EXPECT_NEAR(aim.via[0].y, 1.0, 1e-9);
  EXPECT_NEAR(aim.via[1].x, -1.0, 1e-9);
  EXPECT_NEAR(aim.via[1].y, 1.0, 1e-9);
  EXPECT_EQ(aim.position_tolerance, 0.4);
  EXPECT_EQ(aim.heading_tolerance, 0.2);
}

TEST(AimOf, OneThatStopsHasNoWay) {
  Pursuit pursuit;
  pursuit.via = {{4.0, 6.0}};
  pursuit.heading = Angle::degrees(10);
  const Aim aim = aim_of(pursuit, kGoal, std::nullopt);
  EXPECT_EQ(aim.mode, DriveMode::stop);
  EXPECT_TRUE(aim.via.empty());
  EXPECT_EQ(aim.heading.radians(), 0.0);
  EXPECT_EQ(aim.position_tolerance, 0.4);
}

TEST(AimOf, ALostRobotDrivesToTheEndOfItsShortWayOrTurns) {
  const Aim driving = aim_of(LookAroundStep{true, {1.0, 2.0}, {}});
  EXPECT_EQ(driving.mode, DriveMode::drive);
  EXPECT_TRUE(driving.is_final);
  ASSERT_EQ(driving.via.size(), 1U);
  EXPECT_EQ(driving.via[0].y, 2.0);
  const Aim turning = aim_of(LookAroundStep{false, {1.0, 2.0}, Angle::degrees(100)});
  EXPECT_EQ(turning.mode, DriveMode::turn);
  EXPECT_FALSE(turning.is_final);
  EXPECT_TRUE(turning.via.empty());
  EXPECT_NEAR(turning.heading.degrees(), 100.0, 1e-9);
}

TEST(LookFor, FollowsTheWayForOneAndAHalfMetres) {
  Aim aim;
  aim.mode = DriveMode::drive;
  aim.via = {{1.0, 0.0}, {1.0, 1.0}, {1.0, 2.0}, {-5.0, 2.0}};
  const Look look = look_for(aim, Pose2{0.0, 0.0, Angle::degrees(30)});
  EXPECT_EQ(look.at, GazeAt::way);
  EXPECT_NEAR(look.heading.degrees(), 63.43, 0.01) << "to (1, 2), the first that is far enough";
  EXPECT_NEAR(look.bearing.degrees(), 33.43, 0.01);
  aim.via = {{0.0, 1.0}};
  EXPECT_NEAR(look_for(aim, Pose2{}).heading.degrees(), 90.0, 1e-9) << "the end of a short one";
}

TEST(LookFor, LooksToTheHeadingThatItTurnsToAndElseStraightAhead) {
  Aim aim;
  aim.heading = Angle::degrees(120);
  const Pose2 odom_from_base{0.0, 0.0, Angle::degrees(30)};
  aim.mode = DriveMode::turn;
  Look look = look_for(aim, odom_from_base);
  EXPECT_EQ(look.at, GazeAt::goal);
  EXPECT_NEAR(look.heading.degrees(), 120.0, 1e-9);
  EXPECT_NEAR(look.bearing.degrees(), 90.0, 1e-9);
  aim.mode = DriveMode::stop;
  look = look_for(aim, odom_from_base);
  EXPECT_EQ(look.at, GazeAt::none);
  EXPECT_NEAR(look.heading.degrees(), 30.0, 1e-9);
  EXPECT_NEAR(look.bearing.degrees(), 0.0, 1e-9);
}

}  // namespace
}  // namespace docent::planning::orders_test
