#include "docent/messages/create3/hazard_reading.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "docent/messages/cdr.h"

namespace docent {
namespace {

using irobot_create_msgs::HazardDetection;
using irobot_create_msgs::HazardDetectionVector;

HazardDetectionVector hazard(std::uint8_t type, const std::string& frame) {
  HazardDetectionVector hazards;
  hazards.detections.push_back({{{}, frame}, type});
  return hazards;
}

/// [deg] of the pressed segments, to the left.
std::vector<double> pressed(const HazardReading& reading) {
  std::vector<double> bearings;
  for (std::size_t i = 0; i < reading.segments.size(); ++i)
    if (reading.segments[i] == 1) bearings.push_back(std::remainder(18.0 * static_cast<double>(i), 360.0));
  return bearings;
}

class Hazards : public ::testing::Test {
 protected:
  HazardReading read(const HazardDetectionVector& hazards, const Pose2& odom_from_base = {}, double at_s = 0.0,
                     bool is_kidnapped = false, double speed = 0.2) {
    return reader.read(hazards, is_kidnapped, odom_from_base, speed, time_from_seconds(at_s));
  }
  HazardReader reader{0.18};
};

TEST_F(Hazards, EachBumperPressesItsFifthOfTheFront) {
  EXPECT_TRUE(pressed(read({})).empty());
  EXPECT_EQ(pressed(read(hazard(HazardDetection::kBump, "bump_front_center"))),
            (std::vector<double>{0.0, 18.0, -18.0}));
  EXPECT_EQ(pressed(read(hazard(HazardDetection::kBump, "bump_left"))), (std::vector<double>{54.0, 72.0, 90.0}));
  EXPECT_EQ(pressed(read(hazard(HazardDetection::kBump, "robot1/bump_right"))),
            (std::vector<double>{-90.0, -72.0, -54.0}))
      << "a base with a name space";
  EXPECT_EQ(pressed(read(hazard(HazardDetection::kBump, "bump_of_tomorrow"))).size(), 11U) << "the whole front";
  EXPECT_TRUE(read(hazard(HazardDetection::kBump, "bump_left")).is_touched);
}

TEST_F(Hazards, WhatStallsTheWheelsStandsWhereTheRobotDrivesTo) {
  EXPECT_EQ(pressed(read(hazard(HazardDetection::kStall, "base_link"), {}, 0.0, false, 0.1)).front(), 0.0);
  const auto behind = pressed(read(hazard(HazardDetection::kStall, "base_link"), {}, 0.0, false, -0.1));
  ASSERT_EQ(behind.size(), 3U);
  for (const double bearing : behind) EXPECT_GE(std::abs(bearing), 162.0);
}

TEST_F(Hazards, AnEdgeOfTheFloorStaysWhereItWasFound) {
  const auto felt = read(hazard(HazardDetection::kCliff, "cliff_front_left"));
  ASSERT_EQ(felt.edges.size(), 1U);
  const Point2 middle{0.5 * (felt.edges[0].a.x + felt.edges[0].b.x), 0.5 * (felt.edges[0].a.y + felt.edges[0].b.y)};
  EXPECT_NEAR(std::hypot(middle.x, middle.y), 0.21, 1e-9) << "just before the body";
  EXPECT_NEAR(std::atan2(middle.y, middle.x), 17.0 * std::numbers::pi / 180.0, 1e-9);
  EXPECT_FALSE(felt.is_touched);
  // Half a metre back, turned to the left by 90 degrees: the edge now lies to the right.
  const auto later = read({}, {-0.5, 0.0, Angle::degrees(90.0)}, 100.0);
  ASSERT_EQ(later.edges.size(), 1U);
  EXPECT_NEAR(0.5 * (later.edges[0].a.x + later.edges[0].b.x), middle.y, 1e-9);
  EXPECT_NEAR(0.5 * (later.edges[0].a.y + later.edges[0].b.y), -(middle.x + 0.5), 1e-9);
  EXPECT_TRUE(read({}, {}, 301.0).edges.empty()) << "nobody knows whether it is still there";
}

TEST_F(Hazards, AnEdgeThatIsFeltAgainIsOneAndTheyAreNotEndless) {
  for (int i = 0; i < 50; ++i) static_cast<void>(read(hazard(HazardDetection::kCliff, "cliff_side_right")));
  EXPECT_EQ(reader.edges_remembered(), 1U);
  for (int i = 0; i < 200; ++i)
    static_cast<void>(read(hazard(HazardDetection::kCliff, "cliff_front_left"), {0.2 * i, 0.0, {}}));
  EXPECT_EQ(reader.edges_remembered(), 64U);
}

TEST_F(Hazards, ALiftedRobotFeelsNothingAndForgetsWhereEdgesWere) {
  static_cast<void>(read(hazard(HazardDetection::kCliff, "cliff_front_left")));
  auto lifted = hazard(HazardDetection::kWheelDrop, "wheel_drop_left");
  lifted.detections.push_back({{{}, "cliff_front_right"}, HazardDetection::kCliff});
  const auto reading = read(lifted);
  EXPECT_TRUE(reading.is_lifted);
  EXPECT_TRUE(reading.edges.empty());
  for (const std::uint8_t segment : reading.segments) EXPECT_EQ(segment, 255) << "no reading: the robot stands";
  EXPECT_EQ(reader.edges_remembered(), 0U);
  EXPECT_TRUE(read({}, {}, 1.0, true).is_lifted) << "kidnap_status says so, too";
  EXPECT_FALSE(read({}, {}, 2.0).is_lifted);
}

TEST_F(Hazards, ABaseThatBacksNoFartherHasAWallBehind) {
  const auto reading = read(hazard(HazardDetection::kBackupLimit, "base_link"));
  ASSERT_EQ(reading.edges.size(), 1U);
  EXPECT_NEAR(reading.edges[0].a.x, -0.23, 1e-9);
  EXPECT_NEAR(reading.edges[0].b.x, -0.23, 1e-9);
  EXPECT_TRUE(read({}).edges.empty()) << "it is over once the base says so no more";
}

TEST(Create3Messages, AGoalHasItsIdInBothPlacesWhereAServerLooks) {
  irobot_create_msgs::SendDockGoal goal;
  for (std::uint8_t i = 0; i < 16; ++i) goal.goal_id[i] = goal.request_id[i] = static_cast<std::uint8_t>(i + 1);
  const auto bytes = encode_cdr(goal);
  ASSERT_EQ(bytes.size(), 4U + 16U + 16U + 1U) << "no padding: header of CDR, header of the request, id, dummy";
  for (std::size_t i = 0; i < 16; ++i) {
    EXPECT_EQ(bytes[4 + i], i + 1);
    EXPECT_EQ(bytes[20 + i], i + 1);
  }
}

}  // namespace
}  // namespace docent
