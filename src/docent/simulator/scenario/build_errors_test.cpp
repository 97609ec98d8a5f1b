#include "docent/simulator/scenario/build_errors.h"

#include <gtest/gtest.h>

#include "docent/simulator/scenario/scenario.h"

namespace docent::simulator::build_errors_test {

TEST(BuildErrors, AreReadOfAScenario) {
  const auto scenario = parse_scenario(
      "build: {mounts: {front: {x: 0.1, heading: 10}}, late: {rear: 0.15}, mirrored: [front], "
      "odometry: {way: 1.05, rate: 50}, "
      "start: {y: -0.5, heading: -5}}\nevents: []\n",
      "test");
  ASSERT_TRUE(scenario) << scenario.error().message;
  const BuildErrors& build = scenario->build;
  EXPECT_DOUBLE_EQ(build.mounts.at("front").x, 0.1);
  EXPECT_NEAR(build.mounts.at("front").theta.degrees(), 10.0, 1e-12);
  EXPECT_DOUBLE_EQ(build.late.at("rear"), 0.15);
  EXPECT_EQ(build.mirrored, std::set<std::string>{"front"});
  EXPECT_DOUBLE_EQ(build.way, 1.05);
  EXPECT_DOUBLE_EQ(build.turn, 1.0);
  EXPECT_DOUBLE_EQ(build.rate, 50.0);
  EXPECT_DOUBLE_EQ(build.start.y, -0.5);
}

TEST(BuildErrors, RefuseWhatNobodyMeans) {
  for (const char* wrong :
       {"build: {mount: {}}", "build: 3", "build: {mounts: {front: {z: 1}}}", "build: {late: {front: -1}}",
        "build: {odometry: {way: 0}}", "build: {odometry: {rate: 200}}", "build: {mirrored: front}"})
    EXPECT_FALSE(parse_scenario(std::string{wrong} + "\nevents: []\n", "test")) << wrong;
}

TEST(OdometryScale, StretchesWaysAndTurnsAlone) {
  OdometryScale scale{1.1, 1.0};
  (void)scale.apply({});
  const Pose2 straight = scale.apply({1.0, 0.0, {}});
  EXPECT_NEAR(straight.x, 1.1, 1e-12);
  const Pose2 turned = scale.apply({1.0, 0.0, Angle::degrees(90.0)});
  EXPECT_NEAR(turned.theta.degrees(), 90.0, 1e-9);
  const Pose2 aside = scale.apply({1.0, 1.0, Angle::degrees(90.0)});
  EXPECT_NEAR(aside.y, 1.1, 1e-12);
  EXPECT_NEAR(aside.x, 1.1, 1e-12);
}

}  // namespace docent::simulator::build_errors_test
