#include <gtest/gtest.h>

#include "motion_loop.h"

namespace docent {
namespace {

int counted(const MotionLoop::Outcome& outcome) {
  int sum = 0;
  for (const auto& [kind, count] : outcome.contacts) sum += kind == "bumped" ? 0 : count;
  return sum;
}
std::string story(const MotionLoop::Outcome& outcome) {
  std::string text;
  for (const auto& line : outcome.log) text += line + "\n";
  return text;
}

TEST(Motion, DrivesThroughAQuietMuseumAtWalkingSpeed) {
  MotionLoop loop{{.crowd = "empty", .seed = 5}};
  loop.run(300.0);
  const auto& outcome = loop.outcome();
  EXPECT_EQ(counted(outcome), 0) << story(outcome);
  EXPECT_EQ(outcome.seconds_outside, 0.0);
  EXPECT_EQ(outcome.given_up, 0);
  EXPECT_GE(outcome.arrived, 6);
  EXPECT_GT(outcome.distance / outcome.goal_seconds, 0.45);
}

TEST(Motion, TouchesNobodyInABusyMuseum) {
  double distance = 0.0;
  double seconds = 0.0;
  for (const auto& [museum, seed] : {std::pair{"museums/bonn", 1}, {"museums/bonn", 2}, {"museums/smithsonian", 3}}) {
    MotionLoop loop{{.museum = museum, .crowd = "busy", .seed = static_cast<std::uint64_t>(seed)}};
    loop.run(600.0);
    const auto& outcome = loop.outcome();
    EXPECT_EQ(counted(outcome), 0) << story(outcome);
    EXPECT_EQ(outcome.seconds_outside, 0.0);
    EXPECT_EQ(outcome.given_up, 0) << story(outcome);
    distance += outcome.distance;
    seconds += outcome.goal_seconds;
  }
  EXPECT_GT(distance, 450.0);
  EXPECT_GT(distance / seconds, 0.25);
}

TEST(Motion, ARobotBlindToPeopleDoesTouchThem) {
  MotionLoop loop{{.crowd = "busy", .seed = 23, .settings = {"evaluation.blind_to_people=true"}}};
  loop.run(600.0);
  EXPECT_GT(counted(loop.outcome()), 0);
}

TEST(Motion, StandsOrSlowsWhileASensorIsBrokenAndGoesOnAfterwards) {
  constexpr const char* kEvents = R"(
events:
  - {at: 40, fault: {sensor: laser_front, kind: dead, for: 15}}
  - {at: 80, fault: {sensor: laser_rear, kind: frozen, for: 15}}
  - {at: 120, fault: {sensor: laser_front, kind: half, for: 30}}
  - {at: 170, fault: {sensor: laser_front, kind: late, delay: 0.6, for: 15}}
  - {at: 210, fault: {sensor: odom, kind: half, for: 15}}
  - {at: 250, fault: {sensor: sonar, kind: dead, for: 15}}
  - {at: 290, fault: {sensor: laser_front, kind: frozen, for: 15}}
  - {at: 330, fault: {sensor: odom, kind: dead, for: 15}}
  - {at: 370, visitors: {count: 5, formation: wall, for: 30}}
  - {at: 430, visitors: {count: 8, formation: ushape, for: 30}}
)";
  const auto scenario = simulator::parse_scenario(kEvents, "faults");
  ASSERT_TRUE(scenario) << scenario.error().message;
  MotionLoop loop{{.crowd = "busy", .seed = 8, .scenario = *scenario}};
  loop.run(370.0);
  const double before = loop.outcome().distance;
  EXPECT_GT(before, 50.0);
  for (const char* reason : {"stopped: no fresh sweep of the front laser", "stopped: no fresh odometry",
                             "stopped: no fresh sonar reading", "stopped: the rear laser is frozen"}) {
    EXPECT_TRUE(loop.outcome().standing.contains(reason)) << reason;
  }
  loop.run(230.0);
  EXPECT_GT(loop.outcome().distance, before + 20.0);
  EXPECT_EQ(counted(loop.outcome()), 0) << story(loop.outcome());
}

TEST(Motion, TheSameSeedGivesTheSameRun) {
  const auto run = [] {
    MotionLoop loop{{.crowd = "busy", .seed = 4}};
    loop.run(120.0);
    return loop.outcome();
  };
  const auto first = run();
  const auto second = run();
  EXPECT_EQ(first.distance, second.distance);
  EXPECT_EQ(first.contacts, second.contacts);
  EXPECT_EQ(first.standing, second.standing);
}

}  // namespace
}  // namespace docent
