#include "docent/simulator/scenario/scenario.h"

#include <gtest/gtest.h>

namespace docent::simulator::scenario_test {
namespace {

TEST(Scenario, ReadsEveryKindOfEventInOrderOfTime) {
  const auto scenario = parse_scenario(R"(events:
  - {at: 300, kill: {module: plan, signal: stop, for: 10}}
  - at: 10
    kidnap: {to: [3.0, 4.5], heading: 90}
  - {at: 20, kidnap: }
  - {at: 30, fault: {sensor: laser_rear, kind: late, for: 12, delay: 0.4}}
  - {at: 40, stool: {at: [1, 2], radius: 0.3, for: 60}}
  - {at: 50, closed: {from: [0, 0], to: [0, 2]}}
  - {at: 60, pose_error: {x: 0.5, heading: 10}}
  - {at: 70, visitors: {count: 6, at: [5, 5], formation: wall, heading: 180, for: 45}}
  - {at: 80, request: {kind: tour, target: space, language: de}}
  - {at: 90, second_mode: {at: [3, 4], heading: 90, for: 20}}
  - {at: 95, odometry_jump: {x: 1, heading: -40, over: 2}}
  - {at: 99, fault: {sensor: tactile, kind: half}}
  - {at: 100, visitors: {count: 4, at: [5, 5], formation: wall, heading: 90, heeds: 0.5}}
  - {at: 105, pushers: {count: 5, at: [6, 7], heading: -90, for: 120}}
  - {at: 107, request: {target: airbus, viewpoint: 3, source: web}}
  - {at: 110, runners: {count: 3, at: [6, 7], within: 2.5}}
  - {at: 120, charger: {kind: claims, for: 90}}
)",
                                       "s.yaml");
  ASSERT_TRUE(scenario) << scenario.error().message;
  const auto& events = scenario->events;
  ASSERT_EQ(events.size(), 17U);
  const auto& kidnap = std::get<Kidnap>(events[0].what);
  ASSERT_TRUE(kidnap.to);
  EXPECT_DOUBLE_EQ(kidnap.to->y, 4.5);
  EXPECT_NEAR(kidnap.to->theta.degrees(), 90.0, 1e-9);
  EXPECT_FALSE(std::get<Kidnap>(events[1].what).to);
  const auto& fault = std::get<SensorFault>(events[2].what);
  EXPECT_EQ(fault.sensor, Sensor::laser_rear);
  EXPECT_EQ(fault.kind, FaultKind::late);
  EXPECT_DOUBLE_EQ(fault.delay, 0.4);
  EXPECT_DOUBLE_EQ(fault.duration, 12.0);
  EXPECT_DOUBLE_EQ(std::get<Stool>(events[3].what).radius, 0.3);
  EXPECT_DOUBLE_EQ(std::get<ClosedPassage>(events[4].what).to.y, 2.0);
  EXPECT_DOUBLE_EQ(std::get<PoseError>(events[5].what).x, 0.5);
  EXPECT_EQ(std::get<Visitors>(events[6].what).formation, Formation::wall);
  EXPECT_EQ(std::get<Visitors>(events[6].what).count, 6);
  EXPECT_EQ(std::get<Wish>(events[7].what).kind, "tour");
  EXPECT_EQ(std::get<Wish>(events[7].what).viewpoint, -1);
  EXPECT_EQ(std::get<Wish>(events[7].what).source, "");
  EXPECT_EQ(std::get<Wish>(events[13].what).viewpoint, 3);
  EXPECT_EQ(std::get<Wish>(events[13].what).source, "web");
  EXPECT_DOUBLE_EQ(std::get<SecondMode>(events[8].what).at.y, 4.0);
  EXPECT_DOUBLE_EQ(std::get<SecondMode>(events[8].what).duration, 20.0);
  EXPECT_NEAR(std::get<OdometryJump>(events[9].what).by.theta.degrees(), -40.0, 1e-9);
  EXPECT_DOUBLE_EQ(std::get<OdometryJump>(events[9].what).over, 2.0);
  EXPECT_EQ(std::get<SensorFault>(events[10].what).sensor, Sensor::tactile);
  EXPECT_FALSE(std::get<Visitors>(events[6].what).heeds);
  EXPECT_DOUBLE_EQ(*std::get<Visitors>(events[11].what).heeds, 0.5);
  EXPECT_NEAR(std::get<Pushers>(events[12].what).heading, -1.5708, 1e-4);
  EXPECT_EQ(std::get<ChargerFault>(events[15].what).kind, ChargerFault::Kind::claims);
  EXPECT_DOUBLE_EQ(std::get<ChargerFault>(events[15].what).duration, 90.0);
  EXPECT_EQ(std::get<Pushers>(events[12].what).count, 5);
  EXPECT_DOUBLE_EQ(std::get<Runners>(events[14].what).within, 2.5);
  EXPECT_EQ(std::get<Kill>(events[16].what).signal, "stop");
  EXPECT_DOUBLE_EQ(events[16].at, 300.0);
}

TEST(Scenario, ReadsAWayAndAReach) {
  const auto scenario = parse_scenario(
      "events:\n  - {at: 1, steering: {way: [[1, 2], [3, 4.5]]}}\n  - {at: 2, lasers: {reach: 2.5}}", "s.yaml");
  ASSERT_TRUE(scenario) << scenario.error().message;
  const auto& steering = std::get<Steering>(scenario->events[0].what);
  ASSERT_EQ(steering.way.size(), 2U);
  EXPECT_DOUBLE_EQ(steering.way[1].y, 4.5);
  EXPECT_DOUBLE_EQ(std::get<LaserReach>(scenario->events[1].what).range, 2.5);
}

TEST(Scenario, ReadsWhatWaitsForAMoment) {
  const auto scenario = parse_scenario(R"(events:
  - {at: 60, during: explaining, after: 2.5, kill: {module: mission}}
  - {at: 70, during: driving, battery: {charge: 0.15}}
  - {at: 80, answers: {more: 0.1, next: 0.9}}
  - {at: 90, answers: }
)",
                                       "s.yaml");
  ASSERT_TRUE(scenario) << scenario.error().message;
  const auto& events = scenario->events;
  ASSERT_TRUE(events[0].during);
  EXPECT_EQ(events[0].during->phase, MissionPhase::explaining);
  EXPECT_DOUBLE_EQ(events[0].during->after, 2.5);
  ASSERT_TRUE(events[1].during);
  EXPECT_DOUBLE_EQ(events[1].during->after, 0.0);
  EXPECT_DOUBLE_EQ(std::get<BatteryChange>(events[1].what).charge, 0.15);
  EXPECT_FALSE(events[2].during);
  EXPECT_DOUBLE_EQ(std::get<Answers>(events[2].what).next, 0.9);
  EXPECT_DOUBLE_EQ(std::get<Answers>(events[3].what).more, 0.0);
}

struct Broken {
  const char* text;
  const char* fault;
};
class BrokenScenario : public testing::TestWithParam<Broken> {};

TEST_P(BrokenScenario, IsRefusedInOneLineWithFileAndLine) {
  const auto scenario = parse_scenario(GetParam().text, "s.yaml");
  ASSERT_FALSE(scenario);
  EXPECT_EQ(scenario.error().message, GetParam().fault);
}

constexpr Broken kBroken[] = {
    {"", "s.yaml:1: expected a mapping with 'events'"},
    {"events: 3", "s.yaml:1: 'events' must be a list"},
    {"event: []", "s.yaml:1: unknown key 'event' (known: build, events)"},
    {"events:\n  - 5", "s.yaml:2: expected an event {at: SECONDS, KIND: {...}}"},
    {"events:\n  - {kidnap: }", "s.yaml:2: missing key 'at'"},
    {"events:\n  - {at: 3}", "s.yaml:2: the event has no kind"},
    {"events:\n  - {at: soon, kidnap: }", "s.yaml:2: expected a number, found 'soon'"},
    {"events:\n  - {at: -1, kidnap: }", "s.yaml:2: expected a number from 0 to 100000000, found -1"},
    {"events:\n  - {at: .nan, kidnap: }", "s.yaml:2: expected a number from 0 to 100000000, found nan"},
    {"events:\n  - {at: 1, at: 2, kidnap: }", "s.yaml:2: key 'at' stands twice"},
    {"events:\n  - {at: 1, kidnap: , stool: {at: [1, 2]}}", "s.yaml:2: one kind an event: 'kidnap' or 'stool'"},
    {"events:\n  - {at: 1, abduct: }",
     "s.yaml:2: unknown kind 'abduct' (known: kidnap, fault, stool, closed, pose_error, "
     "visitors, pushers, runners, escort, steering, lasers, request, answers, battery, kill, second_mode, "
     "odometry_jump, lie, transport, charger, eye, office)"},
    {"events:\n  - at: 1\n    kidnap: {to: [1]}", "s.yaml:3: expected a point [x, y]"},
    {"events:\n  - at: 1\n    kidnap: {where: [1, 2]}",
     "s.yaml:3: unknown key 'where' (known: from_hazards, heading, keeps_speed, near_hazards, shift, to, turn)"},
    {"events:\n  - at: 1\n    kidnap: {to: [1, 2], shift: 3}", "s.yaml:3: 'to' or 'shift', not both"},
    {"events:\n  - at: 1\n    kidnap: [1, 2]", "s.yaml:3: expected a mapping (key: value)"},
    {"events:\n  - at: 1\n    fault: {sensor: nose, kind: dead}",
     "s.yaml:3: expected one of laser_front, laser_rear, laser_left, laser_right, sonar, odom, tactile, infrared, "
     "found 'nose'"},
    {"events:\n  - at: 1\n    lie: {sensor: sonar, kind: silent}", "s.yaml:3: only lasers lie"},
    {"events:\n  - at: 1\n    lie: {sensor: laser_rear, kind: white}",
     "s.yaml:3: expected one of units, silent, sector, too_near, blind_near, offset, scaled, stale, looped, found "
     "'white'"},
    {"events:\n  - at: 1\n    fault: {sensor: odom, kind: sad}",
     "s.yaml:3: expected one of dead, frozen, half, late, short, deaf, storm, found 'sad'"},
    {"events:\n  - at: 1\n    fault: {sensor: odom, kind: deaf}", "s.yaml:3: odometry has no ranges to be wrong"},
    {"events:\n  - at: 1\n    fault: {sensor: tactile, kind: storm}",
     "s.yaml:3: the tactile ring has no ranges to be wrong"},
    {"events:\n  - at: 1\n    odometry_jump: {}", "s.yaml:3: a jump of nothing"},
    {"events:\n  - at: 1\n    second_mode: {heading: 3}", "s.yaml:3: missing key 'at'"},
    {"events:\n  - at: 1\n    fault: {sensor: odom}", "s.yaml:3: missing key 'kind'"},
    {"events:\n  - at: 1\n    fault:", "s.yaml:3: missing key 'sensor'"},
    {"events:\n  - at: 1\n    stool: {at: [1, 2], radius: 9}", "s.yaml:3: expected a number from 0.05 to 2, found 9"},
    {"events:\n  - at: 1\n    stool: {at: [1, 2], at: [1, 2]}", "s.yaml:3: key 'at' stands twice"},
    {"events:\n  - at: 1\n    closed: {from: [1, 2], to: [1, 2]}", "s.yaml:3: 'from' and 'to' are the same point"},
    {"events:\n  - at: 1\n    pose_error: {}", "s.yaml:3: a pose error of nothing"},
    {"events:\n  - at: 1\n    visitors: {count: 2.5}", "s.yaml:3: expected a whole number"},
    {"events:\n  - at: 1\n    visitors: {count: 0}", "s.yaml:3: expected a number from 1 to 500, found 0"},
    {"events:\n  - at: 1\n    visitors: {count: 3, formation: [wall]}", "s.yaml:3: expected a text"},
    {"events:\n  - at: 1\n    escort: {count: 3, near: 2, far: 1}", "s.yaml:3: 'far' must not be less than 'near'"},
    {"events:\n  - at: 1\n    escort: {near: 2}", "s.yaml:3: missing key 'count'"},
    {"events:\n  - at: 1\n    steering: {speed: 9}", "s.yaml:3: expected a number from 0.05 to 1.7, found 9"},
    {"events:\n  - at: 1\n    steering: {way: []}", "s.yaml:3: expected a list of points [[x, y], …]"},
    {"events:\n  - at: 1\n    lasers: {reach: 0.1}", "s.yaml:3: expected a number from 0.5 to 10, found 0.1"},
    {"events:\n  - at: 1\n    lasers: {}", "s.yaml:3: missing key 'reach'"},
    {"events:\n  - at: 1\n    request: {kind: cancel, target: a}",
     "s.yaml:3: expected one of exhibit, tour, point, found 'cancel'"},
    {"events:\n  - at: 1\n    kill: {signal: stop}", "s.yaml:3: missing key 'module'"},
    {"events:\n  - at: 1\n    answers: {more: 0.6, next: 0.6}", "s.yaml:3: 'more' and 'next' are more than 1 together"},
    {"events:\n  - at: 1\n    answers: {yes: 0.6}", "s.yaml:3: unknown key 'yes' (known: more, next)"},
    {"events:\n  - at: 1\n    battery: {}", "s.yaml:3: missing key 'charge'"},
    {"events:\n  - at: 1\n    battery: {charge: 15}", "s.yaml:3: expected a number from 0 to 1, found 15"},
    {"events:\n  - at: 1\n    during: dancing\n    kidnap:",
     "s.yaml:3: expected one of waking, relocalizing, idle, driving, explaining, asking, going_home, charging, "
     "waiting, "
     "found 'dancing'"},
    {"events:\n  - at: 1\n    during: [idle]\n    kidnap:", "s.yaml:3: expected a text"},
    {"events:\n  - at: 1\n    during: idle\n    during: idle\n    kidnap:", "s.yaml:4: key 'during' stands twice"},
    {"events:\n  - at: 1\n    after: 2\n    kidnap:", "s.yaml:2: 'after' needs 'during'"},
    {"events:\n  - {at: 1, during: idle, after: -2, kidnap: }",
     "s.yaml:2: expected a number from 0 to 100000000, found -2"},
};
INSTANTIATE_TEST_SUITE_P(Cases, BrokenScenario, testing::ValuesIn(kBroken));

TEST(Scenario, FaultsOfTheYamlItselfNameTheLine) {
  const auto scenario = parse_scenario("events:\n  - {at: 1\nx: [", "s.yaml");
  ASSERT_FALSE(scenario);
  EXPECT_EQ(scenario.error().message.rfind("s.yaml:", 0), 0U) << scenario.error().message;
  const auto missing = load_scenario("/nowhere/s.yaml");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().message.rfind("/nowhere/s.yaml", 0), 0U);
}

}  // namespace
}  // namespace docent::simulator::scenario_test
