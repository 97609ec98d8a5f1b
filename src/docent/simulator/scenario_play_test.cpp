#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "docent/messages/conversions.h"
#include "docent/simulator/museum_bench.h"

namespace docent::simulator::scenario_play_test {
namespace {

/// An empty hall in which nobody asks for anything and a scenario is played.
SimulationOptions playing(const std::string& scenario) {
  SimulationOptions result = options("empty", Pose2{3.0, 4.0, Angle{}});
  result.scenario = parse_scenario(scenario, "s.yaml").value();
  result.requests_per_hour = 0.0;
  return result;
}

TEST(ScenarioPlay, AKidnapMayTurnTheRobotAndShiftItALittle) {
  Bench bench{playing("events:\n  - {at: 1, kidnap: {shift: 1.5, turn: 180}}\n")};
  bench.run(2.0);
  const Pose2 pose{bench.state.x, bench.state.y, Angle::radians(bench.state.theta)};
  EXPECT_NEAR(std::abs(pose.theta.degrees()), 180.0, 1e-6);
  EXPECT_GT(distance(pose.position(), {3.0, 4.0}), 0.01);
  EXPECT_LE(distance(pose.position(), {3.0, 4.0}), 1.5);
}

TEST(ScenarioPlay, AKidnapMayEndBesideAHazard) {
  const SimulationOptions near = playing("events:\n  - {at: 1, kidnap: {near_hazards: 0.3}}\n");
  Bench bench{near};
  bench.run(2.0);
  double gap = 1e9;
  for (const Solid& solid : near.world.solids)
    if (solid.kind == SolidKind::glass || solid.kind == SolidKind::plate || solid.kind == SolidKind::stairs)
      gap = std::min(gap, distance(solid.polygon, Point2{bench.state.x, bench.state.y}) - 0.265);
  EXPECT_GE(gap, 0.04);
  EXPECT_LE(gap, 0.31);
}

TEST(ScenarioPlay, WhatWaitsForAMomentHoldsUpNothingElse) {
  Bench bench{playing(R"(events:
  - {at: 1, during: explaining, after: 2, kill: {module: mission}}
  - {at: 2, during: driving, stool: {at: [15, 7]}}
  - {at: 3, battery: {charge: 0.25}}
)")};
  const auto missions = bench.robot_bus->publisher(topics::kMissionState);
  const auto say = [&](const char* phase) {
    docent_msgs::MissionState state;
    state.phase = phase;
    missions.publish(state);
  };
  const auto told = [&](const std::string& kind) {
    return std::count_if(bench.offers.begin(), bench.offers.end(),
                         [&](const auto& offer) { return offer.kind == kind; });
  };
  say("driving");
  bench.run(0.5);
  EXPECT_EQ(told("stool"), 0);  // its time has not come
  say("explaining");
  bench.run(2.0);  // 2.5: explaining since 0.5, so that the kill is due now
  EXPECT_EQ(told("stool"), 0);
  bench.run(0.1);
  EXPECT_EQ(told("kill"), 1);
  bench.run(1.0);
  EXPECT_NEAR(bench.state.battery, 0.25, 0.001);
  say("driving");
  bench.run(0.1);
  EXPECT_EQ(told("stool"), 1);
  say("explaining");
  bench.run(5.0);
  EXPECT_EQ(told("kill"), 1);  // each event is played once
}

TEST(ScenarioPlay, TheApplicationDoesItsPartWhenTheTimeHasCome) {
  auto options = playing("events:\n  - {at: 1, kill: {module: mission}}\n  - {at: 2, pose_error: {x: 1}}\n");
  std::vector<std::size_t> asked;
  options.application = [&](const auto& event) { asked.push_back(event.index()); };
  Bench bench{std::move(options)};
  bench.run(1.5);
  EXPECT_EQ(asked, std::vector<std::size_t>{0});
  bench.run(1.0);
  EXPECT_EQ(asked, (std::vector<std::size_t>{0, 1}));
}

TEST(ScenarioPlay, VisitorsAnswerOrGo) {
  const auto answers = [](const std::string& chances) {
    Bench bench{playing("events:\n  - {at: 1, answers: " + chances + "}\n")};
    const auto missions = bench.robot_bus->publisher(topics::kMissionState);
    bench.run(1.5);
    for (int i = 0; i < 30; ++i) {
      docent_msgs::MissionState state;
      state.prompt = {"question-" + std::to_string(i), "en", {"en"}, {"More, or next?"}, {"more", "next"}, "next", {}};
      missions.publish(state);
      bench.run(0.1);
    }
    bench.run(5.0);
    return bench.counts[topics::kChoice.name];
  };
  EXPECT_EQ(answers("{more: 0.5, next: 0.5}"), 30);
  EXPECT_EQ(answers("{}"), 0);
}

TEST(ScenarioPlay, SonarsDieInManyWays) {
  Bench bench{playing(R"(events:
  - {at: 1, fault: {sensor: sonar, kind: short, for: 1}}
  - {at: 3, fault: {sensor: sonar, kind: deaf, for: 1}}
  - {at: 5, fault: {sensor: sonar, kind: storm, for: 4}}
)")};
  std::vector<std::pair<std::string, sensor_msgs::Range>> heard;
  bench.robot_bus->subscribe(
      topics::kSonar, std::function<void(const sensor_msgs::Range&)>{
                          [&](const sensor_msgs::Range& range) { heard.emplace_back(range.header.frame_id, range); }});
  std::map<std::string, float> well;
  bench.run(1.0);
  for (const auto& [frame, range] : heard) well[frame] = range.range;
  ASSERT_EQ(well.size(), 24U);
  bench.run(0.1), heard.clear(), bench.run(0.8);  // 1.9
  EXPECT_GE(heard.size(), 40U);
  for (const auto& [frame, range] : heard) EXPECT_FLOAT_EQ(range.range, 0.3F);
  bench.run(1.2), heard.clear(), bench.run(0.8);  // 3.9
  EXPECT_GE(heard.size(), 40U);
  for (const auto& [frame, range] : heard) EXPECT_EQ(range.range, range.max_range);
  bench.run(1.2), heard.clear(), bench.run(3.8);  // 8.9
  const auto shorter = std::count_if(heard.begin(), heard.end(), [&](const auto& reading) {
    return reading.second.range < well[reading.first] - 0.1F;
  });
  EXPECT_GT(shorter, static_cast<std::ptrdiff_t>(heard.size() / 5));
  EXPECT_LT(shorter, static_cast<std::ptrdiff_t>(heard.size() * 3 / 4));
}

TEST(ScenarioPlay, PlaysItsScenario) {
  Bench bench{playing(R"(events:
  - {at: 2, kidnap: {to: [8, 8], heading: 90}}
  - {at: 3, fault: {sensor: laser_rear, kind: dead, for: 2}}
  - {at: 6, fault: {sensor: laser_front, kind: half, for: 1}}
  - {at: 8, stool: {at: [8, 9.2], height: 0.45, for: 2}}
  - {at: 12, fault: {sensor: odom, kind: late, delay: 0.4, for: 1}}
  - {at: 14, visitors: {count: 4, formation: wall, for: 5}}
  - {at: 16, request: {target: case}}
)")};
  double ahead = 0.0;
  int invalid = 0;
  double odom_age = 0.0;
  bench.robot_bus->subscribe(
      topics::kScanFront, std::function<void(const sensor_msgs::LaserScan&)>{[&](const sensor_msgs::LaserScan& scan) {
        ahead = static_cast<double>(*std::min_element(scan.ranges.begin() + 85, scan.ranges.begin() + 96));
        invalid = static_cast<int>(
            std::count_if(scan.ranges.begin(), scan.ranges.end(), [](float r) { return std::isnan(r); }));
      }});
  bench.robot_bus->subscribe(topics::kOdometry,
                             std::function<void(const nav_msgs::Odometry&)>{[&](const nav_msgs::Odometry& odometry) {
                               odom_age = to_seconds(bench.hub.now() - from_message(odometry.header.stamp));
                             }});
  bench.run(2.5);
  EXPECT_NEAR(bench.state.x, 8.0, 1e-9);
  EXPECT_NEAR(bench.state.theta, 1.5708, 1e-3);
  bench.run(0.6);
  const int before = bench.counts["scan_rear"];
  bench.run(1.8);
  EXPECT_EQ(bench.counts["scan_rear"], before);
  bench.run(0.5);
  EXPECT_GT(bench.counts["scan_rear"], before);
  bench.run(1.0);  // 6.4
  EXPECT_GT(invalid, 60);
  EXPECT_LT(invalid, 120);
  bench.run(2.6);  // 9.0
  EXPECT_LT(ahead, 1.2);
  bench.run(2.0);  // 11.0
  EXPECT_GT(ahead, 2.0);
  bench.run(1.7);  // 12.7
  EXPECT_NEAR(odom_age, 0.4, 0.01);
  bench.run(2.3);  // 15.0
  EXPECT_EQ(bench.state.people.size(), 4U);
  EXPECT_LT(ahead, 1.7);
  bench.run(2.0);
  ASSERT_FALSE(bench.requests.empty());
  EXPECT_EQ(bench.requests[0].target, "case");
}

TEST(ScenarioPlay, IsWalkedByHandAmidAnEscortWithoutTouchingAnything) {
  const auto walk = [](int escort) {
    SimulationOptions of_walk = options("empty", Pose2{3.0, 3.0, Angle{}}, 4);
    of_walk.scenario.events.push_back({0.0, Steering{0.5, 0.0, {}}});
    if (escort > 0) of_walk.scenario.events.push_back({0.0, Escort{escort, 0.4, 1.2, 0.0}});
    Bench bench{std::move(of_walk)};
    double blocked = 0.0;
    constexpr int kSeconds = 180;
    for (int i = 0; i < kSeconds; ++i) {
      bench.drive(0.0, 0.0, 1.0);  // the robot's own commands do nothing
      blocked += bench.state.blocked_beams / kSeconds;
    }
    EXPECT_TRUE(bench.contacts.empty()) << bench.contacts.size() << " contacts with an escort of " << escort;
    EXPECT_GT(bench.state.distance_m, 45.0) << "with an escort of " << escort;
    return blocked;
  };
  EXPECT_EQ(walk(0), 0.0);
  EXPECT_GT(walk(14), 0.35);
}

TEST(ScenarioPlay, IsWalkedAlongAWayAndThenStands) {
  SimulationOptions of_walk = options("empty", Pose2{3.0, 3.0, Angle{}}, 4);
  // The third point lies in the bench, and the bench in the way to the last.
  const std::vector<Point2> way{{7.0, 3.0}, {7.0, 9.0}, {5.0, 10.2}, {5.0, 11.5}};
  of_walk.scenario.events.push_back({0.0, Steering{0.5, 0.0, way}});
  Bench bench{std::move(of_walk)};
  std::vector<double> nearest(way.size(), 1e9);
  for (int i = 0; i < 600; ++i) {
    bench.drive(0.0, 0.0, 0.1);
    for (std::size_t k = 0; k < way.size(); ++k)
      nearest[k] = std::min(nearest[k], distance(way[k], {bench.state.x, bench.state.y}));
  }
  EXPECT_LT(nearest[0], 0.9);
  EXPECT_LT(nearest[1], 0.9);
  EXPECT_TRUE(bench.contacts.empty());
  EXPECT_LT(distance(way.back(), {bench.state.x, bench.state.y}), 0.3);
  EXPECT_NEAR(bench.state.distance_m, 4.0 + 6.0 + 3.5, 2.5);
  EXPECT_EQ(bench.state.linear, 0.0);
}

TEST(ScenarioPlay, LasersCanBeMadeNearSighted) {
  SimulationOptions near_sighted = options("empty", Pose2{7.0, 7.0, Angle{}}, 4);
  near_sighted.scenario.events.push_back({1.0, LaserReach{2.5}});
  Bench bench{std::move(near_sighted)};
  sensor_msgs::LaserScan scan;
  bench.robot_bus->subscribe(topics::kScanFront, std::function<void(const sensor_msgs::LaserScan&)>{
                                                     [&](const sensor_msgs::LaserScan& s) { scan = s; }});
  bench.run(0.9);
  EXPECT_EQ(scan.range_max, 10.0F);
  EXPECT_GT(*std::max_element(scan.ranges.begin(), scan.ranges.end()), 6.0F);
  bench.run(0.5);
  EXPECT_EQ(scan.range_max, 2.5F);
  EXPECT_EQ(*std::max_element(scan.ranges.begin(), scan.ranges.end()), 2.5F);
}

}  // namespace
}  // namespace docent::simulator::scenario_play_test
