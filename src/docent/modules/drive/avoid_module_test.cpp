#include "docent/modules/drive/avoid_module.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <utility>

#include "docent/collision_avoidance/local_planner/testing.h"
#include "docent/messages/conversions.h"
#include "docent/modules/drive/hazards_module.h"
#include "docent/modules/drive/robot_module.h"
#include "docent/transport/virtual_time_bus.h"

namespace docent::modules {
namespace {

using std::numbers::pi;

/// Avoid, hazards and robot on the bus, before a base that does what cmd_vel says in a hall of 20 x 8 m, with a sure
/// belief and a target far ahead.
class MotionModules : public ::testing::Test {
 protected:
  MotionModules() {
    for (const char* has_no : {"body.infrareds=0", "body.tactile=false"}) EXPECT_TRUE(config.set(has_no));
    museum.area = walls;
    museum.hazards.push_back({"plate", museum::HazardKind::plate, {{9, -3.9}, {11, -3.9}, {11, -1.0}, {9, -1.0}}});
    world->subscribe<geometry_msgs::Twist>(topics::kCommandVelocity, [this](const geometry_msgs::Twist& twist) {
      wanted = twist;
      commanded = world->now();
    });
    world->subscribe<docent_msgs::AvoidState>(topics::kAvoidState, [this](const auto& message) { state = message; });
    world->subscribe<sensor_msgs::LaserScan>(topics::kVirtualScan, [this](const auto& scan) { virtual_scan = scan; });
    world->every(seconds(0.05), [this] { move(); });
    world->every(seconds(0.1), [this] { world->after(seconds(sees_late), [this] { see(); }); });
    world->every(seconds(0.2), [this] { want(); });
    for (int i = 0; i < 24; ++i) world->every(seconds(0.4), [this, i] { ping(i); });
    keeper.publish({{}, false, "", 0, true, "web"});
    start_all();
  }

  void start_all() {
    start(avoid, avoid_bus, "avoid", make_avoid);
    start(hazards, hazards_bus, "hazards", make_hazards);
    start(robot, robot_bus, "robot", make_robot);
  }
  void start(std::unique_ptr<Module>& module, std::unique_ptr<transport::Bus>& bus, const char* name,
             const std::function<Result<std::unique_ptr<Module>>(const ModuleContext&)>& make) {
    module.reset();
    bus = hub.connect(name);
    auto made = make({*bus, museum, config, "", 1, true});
    ASSERT_TRUE(made) << made.error().message;
    module = std::move(*made);
  }
  void kill(std::unique_ptr<Module>& module, std::unique_ptr<transport::Bus>& bus) {
    module.reset();
    bus.reset();
  }
  void run(double duration) { hub.run_until(hub.now() + seconds(duration)); }

  void move() {
    const double dt = 0.05;
    const bool is_live = world->now() - commanded < seconds(0.3);
    const auto approach = [&](double value, double goal, double rate) {
      return value + std::clamp(goal - value, -rate * dt, rate * dt);
    };
    speed = approach(speed, is_live ? wanted.linear.x : 0.0, 1.0);
    turn_rate = approach(turn_rate, is_live ? wanted.angular.z : 0.0, 1.5);
    pose = pose * Pose2{speed * dt, 0.0, Angle::radians(turn_rate * dt)};
    nav_msgs::Odometry odometry;
    odometry.header = {to_message(world->now()), "odom"};
    odometry.pose.pose = to_message(pose);
    odometry.twist.twist.linear.x = speed;
    odometry.twist.twist.angular.z = turn_rate;
    odometry_publisher.publish(odometry);
  }
  void see() {
    for (const bool front : {true, false}) {
      sensor_msgs::LaserScan scan;
      scan.header = {to_message(world->now()), front ? "laser_front" : "laser_rear"};
      scan.angle_min = static_cast<float>(-0.5 * pi);
      scan.angle_increment = static_cast<float>(pi / 180.0);
      scan.range_max = 10.0F;
      const Angle mount = Angle::degrees(front ? 0.0 : 180.0);
      for (int i = 0; i < 181; ++i) {
        const Angle bearing = pose.theta + mount + Angle::radians(-0.5 * pi + i * pi / 180.0);
        double range = 10.0;
        for (const auto& wall : sides(walls)) {
          if (const auto hit = ray_distance(pose.position(), unit(bearing), wall)) range = std::min(range, *hit);
        }
        noise = noise * 1664525U + 1013904223U;  // never twice the same, as a real laser
        scan.ranges.push_back(static_cast<float>(range + 0.001 * (noise >> 28U)));
      }
      if (front) spoil_scan(scan);
      if (!(front ? front_works : rear_works)) continue;
      const double late = !front && ++rear_sweeps % 3 == 0 ? every_third_late : 0.0;
      world->after(seconds(late), [this, front, scan] { (front ? front_publisher : rear_publisher).publish(scan); });
    }
    docent_msgs::Belief belief;
    belief.header = {to_message(world->now()), "map"};
    belief.cells = {
        {static_cast<float>(pose.x), static_cast<float>(pose.y), static_cast<float>(pose.theta.radians()), 1}};
    belief.hypotheses.push_back({pose.x, pose.y, pose.theta.radians(), {}, 0.99});
    belief.odom_pose = to_message(pose);
    belief.p_lost = 0.001;
    belief.localized = true;
    spoil_belief(belief);
    if (localize_works) belief_publisher.publish(belief);
  }
  void ping(int index) {
    sensor_msgs::Range range;
    range.header = {to_message(world->now()),
                    index < 10 ? "sonar_0" + std::to_string(index) : "sonar_" + std::to_string(index)};
    range.field_of_view = 0.26F;
    range.max_range = range.range = 5.0F;
    spoil_range(range);
    if (sonars_work) sonar_publisher.publish(range);
  }
  void want() {
    docent_msgs::Target target;
    target.header = {to_message(world->now()), "odom"};
    target.mode = "drive";
    for (double way = 0.5; way < 3.0; way += 0.5) {
      target.via_x.push_back(wants_inside ? pose.x : pose.x + way);
      target.via_y.push_back(wants_inside ? pose.y + way : 0.0);
    }
    spoil_target(target);
    if (plan_works) target_publisher.publish(target);
  }

  transport::VirtualTimeHub hub;
  museum::Museum museum;
  robot::RobotConfig config;
  std::unique_ptr<transport::Bus> world = hub.connect("world");
  transport::Publisher<docent_msgs::Stop> keeper = world->publisher(topics::kStop);
  transport::Publisher<nav_msgs::Odometry> odometry_publisher = world->publisher(topics::kOdometry);
  transport::Publisher<sensor_msgs::LaserScan> front_publisher = world->publisher(topics::kScanFront);
  transport::Publisher<sensor_msgs::LaserScan> rear_publisher = world->publisher(topics::kScanRear);
  transport::Publisher<sensor_msgs::Range> sonar_publisher = world->publisher(topics::kSonar);
  transport::Publisher<docent_msgs::Belief> belief_publisher = world->publisher(topics::kBelief);
  transport::Publisher<docent_msgs::Target> target_publisher = world->publisher(topics::kTarget);
  geometry_msgs::Twist wanted;
  Time commanded{};
  docent_msgs::AvoidState state;
  sensor_msgs::LaserScan virtual_scan;
  Pose2 pose;
  double speed = 0.0, turn_rate = 0.0;
  std::uint32_t noise = 1, rear_sweeps = 0;
  std::function<void(sensor_msgs::LaserScan&)> spoil_scan = [](auto&) {};  ///< done to what the front laser says
  std::function<void(sensor_msgs::Range&)> spoil_range = [](auto&) {};
  std::function<void(docent_msgs::Belief&)> spoil_belief = [](auto&) {};
  std::function<void(docent_msgs::Target&)> spoil_target = [](auto&) {};
  bool front_works = true, rear_works = true, sonars_work = true, localize_works = true, plan_works = true;
  double sees_late = 0.0, every_third_late = 0.0;  ///< [s]; the latter of the rear laser's sweeps
  bool wants_inside = false;                       ///< wants to go along +y, else along the hall's axis
  Polygon walls{{-2, -4}, {18, -4}, {18, 4}, {-2, 4}};
  std::unique_ptr<transport::Bus> avoid_bus, hazards_bus, robot_bus;
  std::unique_ptr<Module> avoid, hazards, robot;
};

TEST_F(MotionModules, DriveAndPublishWhatTheyDo) {
  run(5.0);
  EXPECT_GT(speed, 0.6);
  EXPECT_EQ(state.state, "driving");
  EXPECT_EQ(virtual_scan.ranges.size(), 2U * 180U);  // of hazards, then of the border
  EXPECT_EQ(avoid->health().state, "ready");
  EXPECT_EQ(hazards->health().state, "ready");
  EXPECT_EQ(robot->health().state, "ready");
  run(25.0);
  EXPECT_LT(pose.x, 18.0 - 0.265);  // the wall
  EXPECT_GT(pose.x, 16.5);
  EXPECT_TRUE(state.path_blocked);
}

TEST_F(MotionModules, SomebodyElsesPlannerIsStoppedBeforeTheWall) {
  start(avoid, avoid_bus, "avoid", [](const auto& context) {
    return make_avoid_with(context, [](const auto&) { return collision_avoidance::testing::headlong({0.4, 0.0}); });
  });
  run(55.0);
  EXPECT_EQ(speed, 0.0);
  EXPECT_LT(pose.x, 18.0 - 0.265);
  EXPECT_GT(pose.x, 16.5);
}

TEST_F(MotionModules, OneScannerInFrontAndNoSonarsDo) {
  ASSERT_TRUE(config.set("body.scanners=[{}]"));
  ASSERT_TRUE(config.set("body.sonars=0"));
  rear_works = sonars_work = false;
  start_all(), run(2.0);
  EXPECT_LE(speed, 0.1) << "what nothing else bears out proves itself first";
  run(7.0);
  EXPECT_GT(speed, 0.6);
  EXPECT_EQ(avoid->health().state, "ready");
  front_works = false;
  run(1.5);
  EXPECT_EQ(speed, 0.0);
  EXPECT_NE(avoid->health().reason.find("front laser"), std::string::npos) << avoid->health().reason;
}

/// On the border of its area or beyond, the way leads inside.
class AtTheBorder : public MotionModules, public ::testing::WithParamInterface<double> {};

TEST_P(AtTheBorder, GetsInsideFromWhereItStands) {
  museum.area = {{-2, -3}, {18, -3}, {18, 3}, {-2, 3}};  // the body has room beyond it
  museum.hazards.clear();
  pose = {5.0, -3.0 + GetParam(), Angle::degrees(90)};
  start_all();
  wants_inside = true;
  run(8.0);
  EXPECT_GT(pose.y, -2.0) << state.reason;
}
INSTANTIATE_TEST_SUITE_P(OnAndBeyond, AtTheBorder, ::testing::Values(0.12, 0.08, 0.02, 0.0, -0.05, -0.1));

/// The area has a door that leaves the robot's centre so much [m] to either side.
class Doors : public MotionModules, public ::testing::WithParamInterface<double> {};

TEST_P(Doors, AreDrivenWhereTheClearanceSaysSo) {
  const double half = GetParam();
  museum.area = {{-2, -3}, {4, -3}, {4, -half}, {5, -half}, {5, -3}, {18, -3},
                 {18, 3},  {5, 3},  {5, half},  {4, half},  {4, 3},  {-2, 3}};
  museum.hazards.clear();
  start_all();
  double widest = 0.0;
  for (int i = 0; i < 200; ++i) {
    run(0.1);
    if (pose.x > 4.0 && pose.x < 5.0) widest = std::max(widest, std::abs(pose.y));
  }
  EXPECT_GT(pose.x, 6.0) << state.reason;
  EXPECT_LT(widest, half);
}
INSTANTIATE_TEST_SUITE_P(Narrow, Doors, ::testing::Values(0.21, 0.25, 0.30, 0.5));

TEST_F(MotionModules, TheBaseStopsWhenAvoidDiesAndGoesOnAfterItsReturn) {
  run(5.0);
  ASSERT_GT(speed, 0.6);
  kill(avoid, avoid_bus);
  run(0.4);
  EXPECT_EQ(wanted.linear.x, 0.0);
  run(0.8);
  EXPECT_EQ(speed, 0.0);
  start(avoid, avoid_bus, "avoid", make_avoid);
  run(3.0);
  EXPECT_GT(speed, 0.4);
}

TEST_F(MotionModules, NoCommandWaitsForATick) {
  run(0.01);  // nobody has stopped the robot, they hear
  kill(avoid, avoid_bus);
  auto drive = world->publisher(topics::kDrive);
  run(0.01);  // the ticks of the robot module fall between the commands
  for (const auto& [linear, angular] :
       {std::pair{0.5, 0.0}, {0.6, 0.0}, {0.2, 0.0}, {-0.3, 0.0}, {0.0, 0.0}, {0.0, 1.0}, {0.0, 0.0}}) {
    drive.publish({{to_message(world->now()), "base_link"}, linear, angular});
    run(0.001);
    EXPECT_EQ(wanted.linear.x, linear);
    EXPECT_EQ(wanted.angular.z, angular);
    run(0.012);
  }
}

TEST_F(MotionModules, EverySweepIsAnsweredByANewCommandAtOnce) {
  sees_late = 0.017;  // between the ticks of avoid and robot
  run(3.0);
  std::vector<double> seen;     // [s] when the second laser of two has
  std::vector<double> decided;  // [s]
  std::vector<double> told;     // [s] when the base was
  world->subscribe<sensor_msgs::LaserScan>(topics::kScanRear,
                                           [&](const auto&) { seen.push_back(to_seconds(world->now())); });
  world->subscribe<docent_msgs::AvoidState>(topics::kAvoidState,
                                            [&](const auto&) { decided.push_back(to_seconds(world->now())); });
  world->subscribe<geometry_msgs::Twist>(topics::kCommandVelocity,
                                         [&](const auto&) { told.push_back(to_seconds(world->now())); });
  run(2.0);
  ASSERT_GT(speed, 0.5);
  ASSERT_GE(seen.size(), 19U);
  EXPECT_LE(decided.size(), seen.size() + 2) << "one choice for two lasers";
  for (const double at : seen) {
    for (const auto* answers : {&decided, &told}) {
      const auto answer = std::lower_bound(answers->begin(), answers->end(), at);
      ASSERT_NE(answer, answers->end());
      EXPECT_LT(*answer - at, 0.001);
    }
  }
}

TEST_F(MotionModules, SweepsThatComeUnevenlyAreAnsweredAsWell) {
  every_third_late = 0.03;
  run(3.0);
  std::vector<double> seen;
  std::vector<double> decided;
  for (const auto& topic : {topics::kScanFront, topics::kScanRear})
    world->subscribe<sensor_msgs::LaserScan>(topic, [&](const auto&) { seen.push_back(to_seconds(world->now())); });
  world->subscribe<docent_msgs::AvoidState>(topics::kAvoidState,
                                            [&](const auto&) { decided.push_back(to_seconds(world->now())); });
  run(3.0);
  ASSERT_GT(speed, 0.5);
  ASSERT_GE(seen.size(), 58U);
  for (const double at : seen) {
    if (at > to_seconds(world->now()) - 0.03) continue;
    const auto answer = std::lower_bound(decided.begin(), decided.end(), at);
    ASSERT_NE(answer, decided.end());
    EXPECT_LT(*answer - at, 0.021);
  }
}

TEST_F(MotionModules, AChoiceDoesNotWaitForALaserThatStaysAway) {
  run(3.0);
  rear_works = false;
  std::vector<double> answered;
  world->subscribe<docent_msgs::AvoidState>(topics::kAvoidState, [&](const auto& decided) {
    answered.push_back(to_seconds(from_message(decided.header.stamp)));
  });
  const double before = to_seconds(world->now());
  run(0.15);
  ASSERT_FALSE(answered.empty());
  EXPECT_LT(answered.front() - before, 0.1 + 0.021);
}

TEST_F(MotionModules, StandWhenALaserOrTheHazardsOrThePlanFallSilent) {
  run(3.0);
  front_works = false;
  run(2.0);
  EXPECT_EQ(speed, 0.0);
  EXPECT_EQ(avoid->health().reason, "no fresh sweep of the front laser");
  front_works = true;
  run(2.0);
  EXPECT_GT(speed, 0.3);
  kill(hazards, hazards_bus);
  run(3.0);
  EXPECT_EQ(speed, 0.0);
  EXPECT_EQ(state.reason, "no fresh virtual measurements");
  start(hazards, hazards_bus, "hazards", make_hazards);
  run(2.0);
  EXPECT_GT(speed, 0.3);
  plan_works = false;
  run(3.0);
  EXPECT_EQ(speed, 0.0);
  EXPECT_EQ(state.reason, "no fresh target");
}

TEST_F(MotionModules, StandForARingThatNeverSpokeAndThatTheBodyHas) {
  for (const auto& [has, name] : {std::pair{"body.infrareds=24", "no fresh infrared reading"},
                                  std::pair{"body.tactile=true", "the tactile ring is silent"}}) {
    config = robot::RobotConfig{};
    for (const char* setting : {"body.infrareds=0", "body.tactile=false", has}) ASSERT_TRUE(config.set(setting));
    start(avoid, avoid_bus, "avoid", make_avoid);
    run(3.0);
    EXPECT_EQ(speed, 0.0);
    EXPECT_EQ(avoid->health().reason, name);
    EXPECT_EQ(state.reason, name);
  }
}

TEST_F(MotionModules, ALostBeliefWearsOutWhileDriving) {
  run(3.0);
  localize_works = false;
  run(2.5);
  EXPECT_EQ(speed, 0.0);
  localize_works = true;
  run(2.0);
  EXPECT_GT(speed, 0.3);
}

TEST_F(MotionModules, AMessageThatIsNoNumberCountsAsNone) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  const auto spoilt = [&](auto& spoil, auto how, const std::string& reason) {
    SCOPED_TRACE(reason);
    run(2.5);
    ASSERT_GT(speed, 0.3);
    const auto well = std::exchange(spoil, how);
    run(2.8);
    EXPECT_EQ(speed, 0.0);
    EXPECT_EQ(state.reason, reason);
    spoil = well;
  };
  const std::string laser = "no fresh sweep of the front laser";
  spoilt(
      spoil_scan, [](auto& scan) { scan.angle_min = kNan; }, laser);
  spoilt(
      spoil_scan, [](auto& scan) { scan.angle_increment = kNan; }, laser);
  spoilt(
      spoil_scan, [](auto& scan) { scan.range_min = kNan; }, laser);
  spoilt(
      spoil_scan, [](auto& scan) { scan.range_max = kNan; }, laser);
  spoilt(
      spoil_range, [](auto& range) { range.field_of_view = kNan; }, "no fresh sonar reading");
  spoilt(
      spoil_range, [](auto& range) { range.max_range = kNan; }, "no fresh sonar reading");
  spoilt(
      spoil_target, [](auto& target) { target.via_y.back() = kNan; }, "no fresh target");
}

TEST_F(MotionModules, VirtualMeasurementsWithoutABorderAreNone) {
  run(3.0);
  ASSERT_GT(speed, 0.6);
  kill(hazards, hazards_bus);
  auto publisher = world->publisher(topics::kVirtualScan);
  const auto drive_by = [&](std::size_t directions) {
    for (int i = 0; i < 25; ++i) {
      sensor_msgs::LaserScan scan = virtual_scan;
      scan.header.stamp = to_message(world->now());
      scan.ranges.assign(directions, scan.range_max);
      publisher.publish(scan);
      run(0.1);
    }
  };
  drive_by(180);  // hazards, and then?
  EXPECT_EQ(speed, 0.0);
  EXPECT_EQ(state.reason, "no fresh virtual measurements");
  ASSERT_TRUE(avoid_bus->refusals().contains(topics::kVirtualScan.name));
  EXPECT_EQ(avoid_bus->refusals().at(topics::kVirtualScan.name).count, 25U);
  EXPECT_EQ(avoid_bus->refusals().at(topics::kVirtualScan.name).last.text(),
            "ranges do not go round twice, for hazards and for the border");
  drive_by(360);
  EXPECT_GT(speed, 0.3);
}

TEST_F(MotionModules, ALimitThatIsNoNumberIsNone) {
  auto limits_publisher = world->publisher(topics::kLimits);
  docent_msgs::Limits limits;
  limits.max_speed = 0.4;
  limits_publisher.publish(limits);
  limits.max_speed = std::numeric_limits<double>::quiet_NaN();
  limits_publisher.publish(limits);
  run(4.0);
  EXPECT_GT(speed, 0.35);
  EXPECT_LT(speed, 0.41);
}

TEST_F(MotionModules, ABeliefThatIsNoNumberKnowsNothing) {
  run(4.0);
  ASSERT_GT(speed, 0.6);
  spoil_belief = [](auto& belief) { belief.p_lost = std::nan(""); };
  run(0.5);
  EXPECT_EQ(state.reason, "the position is not known");
  run(3.0);
  EXPECT_EQ(speed, 0.0) << "and no hazards are known from it";
}

TEST_F(MotionModules, RefuseBadParameters) {
  ASSERT_TRUE(config.set("avoid.lookahead=99"));
  const auto made = make_avoid({*world, museum, config, "", 1, true});
  ASSERT_FALSE(made);
  EXPECT_NE(made.error().message.find("avoid.lookahead"), std::string::npos);
}

}  // namespace
}  // namespace docent::modules
