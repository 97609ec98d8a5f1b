#include "docent/collision_avoidance/avoider/avoider.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>

#include "docent/collision_avoidance/avoider/rehearsal_for_test.h"

namespace docent {
namespace {

TEST(Avoider, ReachesWalkingSpeedInTheOpenAndStopsAtTheGoal) {
  Rehearsal world;
  world.box(-3, -5, 15, 5);
  world.drive_to({{1, 0}, {2, 0}, {4, 0}, {8, 0}, {12, 0}});
  ASSERT_TRUE(world.run_until_arrived(30));
  EXPECT_GT(world.top_speed, 0.69);
  EXPECT_LT(world.top_speed, 0.71);  // until told otherwise
  EXPECT_LT(to_seconds(world.now), 22.0);
  EXPECT_LT(world.driven, 12.3);
}

TEST(Avoider, DrivesThroughADoorOfNinetyCentimetres) {
  for (const double offset : {0.0, 0.3, -0.3}) {
    Rehearsal world{7};
    world.box(-3, -3, 8, 3);
    world.walls.push_back({{3, -3}, {3, -0.45}});
    world.walls.push_back({{3, 0.45}, {3, 3}});
    world.walls.push_back({{3.2, -3}, {3.2, -0.45}});
    world.walls.push_back({{3.2, 0.45}, {3.2, 3}});
    world.map_from_base = {0.0, offset, {}};
    world.drive_to({{1, 0}, {2, 0}, {3.1, 0}, {4.5, 0}, {6, 0}});
    EXPECT_TRUE(world.run_until_arrived(30)) << "from y = " << offset << ", at " << world.map_from_base.x;
    EXPECT_GT(world.least_wall, 0.05);
    EXPECT_LT(to_seconds(world.now), 20.0);
  }
}

TEST(Avoider, TurnsOnTheSpotAndFindsBack) {
  Rehearsal world;
  world.box(-3, -3, 6, 3);
  world.drive_to({{-2, 0}});
  ASSERT_TRUE(world.run_until_arrived(30));
  EXPECT_LT(world.driven, 2.6);
  world.target.mode = AvoiderTarget::Mode::turn;
  world.target.heading = Angle::degrees(-30);
  world.run(8);
  EXPECT_NEAR(world.map_from_base.theta.degrees(), -30.0, 6.0);
  EXPECT_LT(std::abs(world.velocity.angular), 0.01);
}

TEST(Avoider, KeepsClearOfAHazardThatNoSensorSees) {
  Rehearsal world;
  world.box(-3, -5, 12, 5);
  world.hazards = sides({{3, -1}, {5, -1}, {5, 1}, {3, 1}});
  world.drive_to({{8, 0}});  // straight through
  world.run(40);
  EXPECT_GT(world.least_wall, 0.12);
}

TEST(Avoider, PassesBesideAHazardAlongViaPoints) {
  Rehearsal world;
  world.box(-3, -1.7, 12, 5);
  world.hazards = sides({{3, -0.4}, {5, -0.4}, {5, 1}, {3, 1}});  // leaves 1.3 m to the wall
  world.drive_to({{1, -0.5}, {2, -1.05}, {3, -1.05}, {4, -1.05}, {5, -1.05}, {6, -0.7}, {8, 0}});
  EXPECT_TRUE(world.run_until_arrived(60));
  EXPECT_GT(world.least_wall, 0.06);
}

TEST(Avoider, DoesNotPushAPersonWhoComesTowardsIt) {
  for (const double speed : {0.5, 0.9, 1.3}) {
    Rehearsal world{3};
    world.box(-3, -4, 20, 4);
    world.drive_to({{2, 0}, {4, 0}, {8, 0}, {15, 0}});
    world.people.push_back({{9, 0.1}, {-speed, 0.0}});
    world.run(14);
    EXPECT_LE(world.worst_push, 0.1) << "a person at " << speed << " m/s";
  }
}

TEST(Avoider, DoesNotPushAPersonWhoCrosses) {
  for (const double start : {1.5, 2.0, 2.5, 3.0, 3.5}) {
    Rehearsal world{5};
    world.box(-3, -6, 20, 6);
    world.drive_to({{2, 0}, {4, 0}, {8, 0}, {15, 0}});
    world.people.push_back({{4.0, start}, {0.0, -0.8}});
    world.run(12);
    EXPECT_LE(world.worst_push, 0.1) << "from y = " << start;
  }
}

/// Along two rows of people, shoulder to shoulder; one of them steps in with 0.7 m/s when the robot is `before` [m]
/// away.
double push_of_who_steps_in(std::uint64_t seed, double before, const AvoiderParams& params) {
  Rehearsal rehearsal{seed, params};
  rehearsal.box(-2.0, -3.0, 10.0, 3.0);
  for (int i = 0; i < 11; ++i) {
    for (const double side : {-1.0, 1.0}) rehearsal.people.push_back({{1.0 + 0.48 * i, side * 0.72}, {}});
  }
  constexpr std::size_t kSteps = 13;
  rehearsal.drive_to({{7.0, 0.0}});
  while (rehearsal.map_from_base.x < rehearsal.people[kSteps].place.x - before &&
         rehearsal.now < time_from_seconds(30.0))
    rehearsal.run(0.01);
  rehearsal.people[kSteps].velocity = {0.0, -0.7};
  rehearsal.run(1.0);
  rehearsal.people[kSteps].velocity = {};
  rehearsal.run(1.0);
  return rehearsal.worst_push;
}

TEST(Avoider, DoesNotPushWhoStepsOutOfARow) {
  AvoiderParams blunt = Rehearsal::without_sonar();
  blunt.people.surprise = 0.0;
  double worst = 0.0;
  double worst_of_blunt = 0.0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    for (const double before : {0.3, 0.5, 0.7, 0.9}) {
      worst = std::max(worst, push_of_who_steps_in(seed, before, Rehearsal::without_sonar()));
      worst_of_blunt = std::max(worst_of_blunt, push_of_who_steps_in(seed, before, blunt));
    }
  }
  EXPECT_LE(worst, 0.2);
  EXPECT_GT(worst_of_blunt, 0.25);
}

/// A robot that creeps with 0.15 m/s through an empty hall, where somebody then stands, in the end `gap` [m] before it.
/// @return  what the check of the last scan says, without another choice
std::optional<AvoiderDecision> reflex_to_somebody(double gap) {
  constexpr double kDriven = 0.13;  // [m] in all
  Avoider avoider{BaseLimits{}, Rehearsal::without_sonar(), {"front laser"}};
  avoider.set_max_speed(0.15);
  const Point2 person{kDriven + BaseLimits{}.radius + gap + 0.22, 0.0};
  Time now = time_from_seconds(10.0);
  Pose2 odom_from_base;
  for (int i = 0; i < 22; ++i) {
    now = now + seconds(0.05);
    const Velocity velocity = avoider.command();
    odom_from_base = odom_from_base * Pose2{0.05 * velocity.linear, 0.0, {}};
    avoider.add_odometry(now, now, {odom_from_base, velocity});
    SensorSweep sweep{now, {}, -std::numbers::pi, std::numbers::pi / 180.0, 0.02, 10.0, {}};
    for (int k = 0; k < 360; ++k) {
      const auto hit = ray_distance(odom_from_base.position(), unit(Angle::degrees(k - 180.0)), person, 0.22);
      sweep.ranges.push_back(i >= 10 && hit ? static_cast<float>(*hit) : 10.0F);
    }
    avoider.add_sweep(now, 0, sweep);
    avoider.add_virtual(now, {now, -std::numbers::pi, std::numbers::pi / 90.0, 6.0, std::vector<float>(180, 6.0F)});
    AvoiderTarget target;
    target.mode = AvoiderTarget::Mode::drive;
    target.via = {{9.0, 0.0}};
    avoider.set_target(now, now, target);
    if (i == 3 || i == 8) (void)avoider.decide(now);
  }
  EXPECT_NEAR(avoider.command().linear, 0.15, 0.01);
  EXPECT_NEAR(odom_from_base.x, kDriven, 0.03);
  return avoider.reflex(now);
}

TEST(Avoider, TheCheckOfEveryScanSlowsACreepWhereOnlyLessIsHarmless) {
  const auto near = reflex_to_somebody(0.16);
  ASSERT_TRUE(near) << "no reflex";
  EXPECT_EQ(near->reason, "people are near");
  EXPECT_NEAR(near->command.linear, PeopleCautionParams{}.harmless, 1e-6);
  EXPECT_FALSE(reflex_to_somebody(1.5)) << "far off";
}

TEST(Avoider, TheChoiceTakesPeopleAsTheyStandAndTheCheckForeseesThem) {
  for (const double speed : {0.0, 0.9}) {  // towards the robot, which stands
    Avoider avoider{BaseLimits{}, Rehearsal::without_sonar(), {"front laser"}};
    Time now = time_from_seconds(10.0);
    AvoiderTarget target;
    target.mode = AvoiderTarget::Mode::drive;
    target.via = {{9.0, 0.0}};
    for (int i = 15; i >= 0; --i) {
      now = now + seconds(0.05);
      avoider.add_odometry(now, now, {});
      SensorSweep sweep{now, {}, -std::numbers::pi, std::numbers::pi / 180.0, 0.02, 10.0, {}};
      for (int k = 0; k < 360; ++k) {
        const auto hit = ray_distance({}, unit(Angle::degrees(k - 180.0)), {1.04 + 0.05 * i * speed, 0.0}, 0.22);
        sweep.ranges.push_back(hit ? static_cast<float>(*hit) : 10.0F);
      }
      avoider.add_sweep(now, 0, sweep);
      avoider.add_virtual(now, {now, -std::numbers::pi, std::numbers::pi / 90.0, 6.0, std::vector<float>(180, 6.0F)});
      avoider.set_target(now, now, target);
    }
    EXPECT_GT(avoider.decide(now).command.linear, 0.1) << "at " << speed << " m/s";
    const auto check = avoider.reflex(now);
    EXPECT_EQ(check.has_value(), speed > 0.0);
    if (check) {
      EXPECT_LT(check->command.linear, 0.1 + 1e-9);
    }
  }
}

TEST(Avoider, NobodyIsInsideTheRobot) {
  for (const Point2 from : {Point2{0.1, -1.8}, Point2{1.8, 0.15}, Point2{-1.3, 1.3}}) {
    Rehearsal world;
    world.box(-3, -3, 3, 3);
    world.people.push_back({from, (-1.2 / norm(from)) * from});  // walks into it and stops there
    double least = 1.0;
    for (int i = 0; i < 25; ++i) {
      world.run(0.1);
      least = std::min(least, world.decision.nearest_real);
    }
    EXPECT_LT(least, 0.08) << "they came";
    EXPECT_GE(least, -1e-6) << "from " << from.x << "," << from.y;
  }
}

TEST(Avoider, GoesRoundAPersonWhoStandsInTheWay) {
  Rehearsal world;
  world.box(-3, -3, 12, 3);
  world.people.push_back({{4, 0.05}});
  world.drive_to({{1, 0}, {2, 0}, {4, 0}, {6, 0}, {8, 0}});
  EXPECT_TRUE(world.run_until_arrived(60)) << "at " << world.map_from_base.x << "," << world.map_from_base.y;
  EXPECT_LE(world.worst_push, 0.0);
}

TEST(Avoider, SaysThatTheWayIsBlocked) {
  Rehearsal world;
  world.box(-3, -1, 12, 1);
  for (const double y : {-0.8, -0.4, 0.0, 0.4, 0.8}) world.people.push_back({{4, y}});
  world.drive_to({{1, 0}, {2, 0}, {4, 0}, {6, 0}, {8, 0}});
  world.run(20);
  EXPECT_TRUE(world.decision.path_blocked) << world.decision.reason;
  EXPECT_LT(std::abs(world.velocity.linear), 0.06);
  EXPECT_EQ(world.worst_push, 0.0);
}

TEST(Avoider, StopsBeforeWhatOnlyACameraSees) {
  Rehearsal world;
  world.box(-3, -1, 12, 1);
  world.drive_to({{1, 0}, {2, 0}, {4, 0}, {8, 0}});
  for (int i = 0; i < 150; ++i) {  // a picture every 0.1 s: a cable across the way at x = 4
    const Pose2 base_from_map = inverse(world.map_from_base);
    const std::vector<Segment> cable{{base_from_map * Point2{4.0, -1.0}, base_from_map * Point2{4.0, 1.0}}};
    world.avoider.add_lines(world.now, world.now, "front", 0.5, cable);
    world.run(0.1);
  }
  EXPECT_LT(world.map_from_base.x, 4.0 - world.limits.radius);
  EXPECT_GT(world.map_from_base.x, 3.0);
  world.run(3.0);  // the camera falls silent
  EXPECT_EQ(world.avoider.fault(world.now), "no fresh lines of the camera front");
}

TEST(Avoider, StandsWhenTheInfraredRingFallsSilent) {
  Rehearsal world;
  world.box(-3, -5, 40, 5);
  world.drive_to({{2, 0}, {4, 0}, {8, 0}, {30, 0}});
  for (int i = 0; i < 25; ++i) {
    world.avoider.add_infrared(world.now, 0, {world.now, {0.25, 0.0, {}}, 0.09, 0.8, 0.8});
    world.run(0.2);
  }
  EXPECT_GT(world.velocity.linear, 0.5);
  world.run(2.0);
  EXPECT_EQ(world.velocity.linear, 0.0);
  EXPECT_EQ(world.avoider.fault(world.now), "no fresh infrared reading");
}

TEST(Avoider, StandsWhenAnythingItNeedsFallsSilentAndGoesOnWhenItReturns) {
  const std::vector<std::pair<bool Rehearsal::*, const char*>> parts{{&Rehearsal::front_works, "front laser"},
                                                                     {&Rehearsal::rear_works, "rear laser"},
                                                                     {&Rehearsal::odometry_works, "odometry"},
                                                                     {&Rehearsal::virtual_works, "virtual"},
                                                                     {&Rehearsal::target_works, "target"}};
  for (const auto& [part, name] : parts) {
    Rehearsal world;
    world.box(-3, -5, 40, 5);
    world.drive_to({{2, 0}, {4, 0}, {8, 0}, {30, 0}});
    world.run(5);
    ASSERT_GT(world.velocity.linear, 0.5);
    world.*part = false;
    world.run(3.0);
    EXPECT_EQ(world.velocity.linear, 0.0) << name;
    EXPECT_NE(world.decision.reason.find(name), std::string::npos) << world.decision.reason;
    world.*part = true;
    world.run(5);
    EXPECT_GT(world.velocity.linear, 0.5) << name;
  }
}

TEST(Avoider, DoesNotTrustAFrozenLaser) {
  Rehearsal world;
  world.box(-3, -5, 40, 5);
  world.drive_to({{2, 0}, {4, 0}, {8, 0}, {30, 0}});
  world.run(5);
  world.front_repeats = true;
  world.run(1.5);
  EXPECT_EQ(world.velocity.linear, 0.0);
  EXPECT_EQ(world.decision.reason, "the front laser is frozen");
  world.front_repeats = false;
  world.run(4);
  EXPECT_GT(world.velocity.linear, 0.5);
}

TEST(Avoider, CreepsAndSaysWhyWhenHalfOfALasersReadingsAreGone) {
  Rehearsal world;
  world.box(-3, -5, 40, 5);
  world.drive_to({{2, 0}, {4, 0}, {8, 0}, {30, 0}});
  world.run(5);
  ASSERT_GT(world.velocity.linear, 0.5);
  world.front_missing = 0.5;
  world.run(1.5);
  for (int i = 0; i < 40; ++i) {
    world.run(0.25);
    EXPECT_LT(world.velocity.linear, kCrippledSpeed + 0.01);
    EXPECT_EQ(world.decision.reason, "the front laser gives too few readings");
  }
}

TEST(Avoider, AJumpOfTheOdometrySlowsItAndMovesNothingThatItKnows) {
  Rehearsal world;
  world.box(-3, -5, 40, 5);
  world.drive_to({{2, 0}, {4, 0}, {8, 0}, {30, 0}});
  world.run(5);
  ASSERT_GT(world.velocity.linear, 0.5);
  const std::size_t known = world.avoider.memory().points(world.now).size();
  world.raw_from_map = {1.0, -0.4, Angle::degrees(40)};
  world.run(1.0);
  EXPECT_EQ(world.decision.reason, "the odometry jumped");
  EXPECT_LT(world.velocity.linear, kCrippledSpeed + 0.01);
  EXPECT_NEAR(static_cast<double>(world.avoider.memory().points(world.now).size()), static_cast<double>(known),
              0.25 * static_cast<double>(known));
  world.run(5.0);
  EXPECT_GT(world.velocity.linear, 0.5);
  EXPECT_NEAR(world.map_from_base.y, 0.0, 0.1) << "targets are carried over the jump";
}

TEST(Avoider, TheClocksOfOtherComputersDoNotBlindIt) {
  for (const double sensor : {0.0, 5.0, -5.0, 0.6, -0.6}) {
    for (const double odometry : {0.0, sensor, -sensor}) {
      SCOPED_TRACE("sensors " + std::to_string(sensor) + " s, odometry " + std::to_string(odometry) + " s ahead");
      Rehearsal world;
      world.sensor_clock = sensor;
      world.odometry_clock = odometry;
      world.box(-3, -2, 6, 2);
      world.hazards = sides({{2.0, 0.7}, {4.0, 0.7}, {4.0, 1.5}, {2.0, 1.5}});
      world.now = time_from_seconds(20.0);
      world.drive_to({{1, 0.4}, {2, 0}, {4, 0}, {4.5, 1}, {9, 1}});  // the end lies behind the wall
      world.run(3.0);
      EXPECT_GT(world.velocity.linear, 0.4) << world.decision.reason;
      EXPECT_GT(world.avoider.memory().points(world.now).size(), 200U);
      world.run(17.0);
      EXPECT_GT(world.least_wall, 0.03);
      EXPECT_GT(world.driven, 4.0);
    }
  }
}

TEST(Avoider, WithOneLaserInFrontItTurnsAndLooksBeforeItDrives) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    for (const double bearing : {130.0, 150.0, -150.0}) {
      SCOPED_TRACE(bearing);
      Rehearsal rehearsal{seed, Rehearsal::without_sonar(), {"front laser"}};
      rehearsal.box(-5.0, -5.0, 5.0, 5.0);
      const Point2 goal = 3.0 * unit(Angle::degrees(bearing));
      // Somebody stands behind it, nearly in touch, whom it has not seen.
      rehearsal.people.push_back({0.6 * unit(Angle::degrees(bearing > 0.0 ? -135.0 : 135.0)), {}});
      rehearsal.drive_to({goal});
      const auto off = [&] { return std::abs((Angle::degrees(bearing) - rehearsal.map_from_base.theta).degrees()); };
      while (off() > 85.0 && rehearsal.now < time_from_seconds(10.0)) rehearsal.run(0.01);
      EXPECT_LT(rehearsal.driven, 0.03) << "it has not seen what lies there";
      EXPECT_TRUE(rehearsal.run_until_arrived(20.0)) << rehearsal.decision.reason;
      EXPECT_LT(rehearsal.worst_push, 0.02);
      EXPECT_GT(rehearsal.least_wall, 0.05);
    }
  }
}

TEST(Avoider, WithOneLaserInFrontItDrivesAheadAsWithTwo) {
  Rehearsal one{1, Rehearsal::without_sonar(), {"front laser"}};
  Rehearsal two;
  for (Rehearsal* rehearsal : {&one, &two}) {
    rehearsal->box(-2.0, -1.5, 9.0, 1.5);
    rehearsal->drive_to({{4.0, 0.3}, {8.0, 0.0}});
    EXPECT_TRUE(rehearsal->run_until_arrived(30.0)) << rehearsal->decision.reason;
    EXPECT_GT(rehearsal->top_speed, 0.65);
  }
  EXPECT_LT(to_seconds(one.now), 1.1 * to_seconds(two.now));
}

/// A long body that stands or turns on its own behalf: the test is its base, its lasers and what they see.
class LongBody : public ::testing::Test {
 protected:
  LongBody() {
    limits.radius = 0.6;
    limits.outline = Outline::make({{0.5, 0.2}, {-0.5, 0.2}, {-0.5, -0.2}, {0.5, -0.2}}).value();
    avoider.emplace(limits, Rehearsal::without_sonar(), std::vector<std::string>{"front laser"});
  }
  /// One cycle in which the only laser sees `ranges` (NaN: blind).
  void cycle(const std::function<float(Angle)>& range, double field = 360.0) {
    now = now + seconds(0.05);
    avoider->add_odometry(now, now, {odom_from_base, velocity});
    SensorSweep sweep{now, {}, -field * std::numbers::pi / 360.0, std::numbers::pi / 180.0, 0.02, 10.0, {}};
    for (int i = 0; i < static_cast<int>(field); ++i) sweep.ranges.push_back(range(Angle::degrees(i - 0.5 * field)));
    avoider->add_sweep(now, 0, sweep);
    VirtualSweep nothing{now, -std::numbers::pi, std::numbers::pi / 90.0, 6.0, std::vector<float>(180, 6.0F)};
    avoider->add_virtual(now, nothing);
    avoider->set_target(now, now, target);
  }
  void turn() {
    velocity.angular = std::min(1.0, velocity.angular + 0.05 * limits.turn_acceleration);
    odom_from_base = odom_from_base * Pose2{0.0, 0.0, Angle::radians(0.05 * velocity.angular)};
  }
  BaseLimits limits;
  std::optional<Avoider> avoider;
  AvoiderTarget target;
  Time now = time_from_seconds(10.0);
  Pose2 odom_from_base;
  Velocity velocity;
};

TEST_F(LongBody, BrakesATurnForWhatComesBesideIt) {
  target.mode = AvoiderTarget::Mode::turn;
  target.heading = Angle::degrees(170);
  const auto nothing = [](Angle) { return 10.0F; };
  for (int i = 0; i < 20; ++i) {
    cycle(nothing);
    if (i % 5 == 0) (void)avoider->decide(now);
    turn();
  }
  ASSERT_GT(avoider->command().angular, 0.5);
  const auto post = [](Angle bearing) {  // just left of the front left corner, which turns to it
    return std::abs(bearing.degrees() - 45.0) < 3.0 ? 0.45F : 10.0F;
  };
  for (int i = 0; i < 2; ++i) cycle(post);
  const auto decision = avoider->reflex(now);
  ASSERT_TRUE(decision) << "no reflex";
  EXPECT_EQ(decision->reason, "braking");
  EXPECT_EQ(decision->command, Velocity{});
}

TEST_F(LongBody, DoesNotTurnIntoWhatNothingHasSeen) {
  const auto command_of = [&](double field) {
    avoider.emplace(limits, Rehearsal::without_sonar(), std::vector<std::string>{"front laser"});
    target.mode = AvoiderTarget::Mode::turn;
    target.heading = Angle::degrees(170);
    for (int i = 0; i < 20; ++i) {
      cycle([](Angle) { return 10.0F; }, field);
      if (i == 19) (void)avoider->decide(now);
    }
    return avoider->command().angular;
  };
  EXPECT_GT(command_of(360.0), 0.3);
  EXPECT_LT(command_of(180.0), 0.1) << "its tail would sweep what is behind";
}

TEST_F(LongBody, WhatTouchesItOrCannotBeSeenLiesAtItsEdge) {
  const auto blind_to_the_left = [](Angle bearing) {
    return std::abs(bearing.degrees() - 90.0) < 10.0 ? std::numeric_limits<float>::quiet_NaN() : 10.0F;
  };
  cycle(blind_to_the_left);
  EXPECT_NEAR(avoider->decide(now).nearest_real, 0.08, 0.01) << "the margin, from its side and not from its radius";
  std::vector<std::uint8_t> segments(4, 0);
  segments[3] = 1;  // right
  avoider->add_tactile(now, now, segments);
  const auto points = avoider->memory().points(now);
  ASSERT_EQ(points.size(), 1U);
  EXPECT_NEAR(points[0].in_odom.y, -0.2, 1e-9);
  EXPECT_NEAR(avoider->decide(now).nearest_real, 0.0, 1e-9);
}

TEST_F(LongBody, SlowsForWhatIsNearItsEdgeNotItsRadius) {
  target.mode = AvoiderTarget::Mode::drive;
  target.via = {{5.0, 0.0}};
  // A wall 0.5 m beside the middle: 0.3 m from the side, but inside the radius.
  const auto wall = [](Angle bearing) {
    const double aside = std::sin(bearing.radians());
    return aside > 0.11 ? static_cast<float>(0.5 / aside) : 10.0F;
  };
  for (int i = 0; i < 4; ++i) cycle(wall);
  const auto decision = avoider->decide(now);
  EXPECT_NEAR(decision.nearest_real, 0.3, 0.01);
  EXPECT_GT(decision.speed_cap, 0.3) << decision.reason;
}

TEST(Avoider, ADoubtfulPositionSlowsIt) {
  Rehearsal world;
  world.box(-3, -5, 40, 5);
  world.drive_to({{2, 0}, {4, 0}, {8, 0}, {30, 0}});
  world.run(5);
  const std::vector<BelievedPose> modes{{{}, 0.5}, {{9, 9, {}}, 0.5}};
  for (int i = 0; i < 2; ++i) world.avoider.add_belief({modes, modes, 0.02, true});
  world.run(1.5);
  EXPECT_LT(world.velocity.linear, kCrippledSpeed + 0.01);
  EXPECT_EQ(world.decision.reason, "it may be in two places");
  EXPECT_FALSE(world.avoider.complaint_of_inputs(world.now)) << "no sensor is to blame";
}

TEST(Avoider, CrippledItTakesEverythingForWell) {
  AvoiderParams params = Rehearsal::without_sonar();
  params.watches = false;
  Rehearsal world{1, params};
  world.box(-3, -5, 40, 5);
  world.drive_to({{2, 0}, {4, 0}, {8, 0}, {30, 0}});
  world.run(5);
  world.front_works = false;
  world.run(3);
  EXPECT_GT(world.velocity.linear, 0.5);
}

TEST(Avoider, DoesNotDriveWhereTheLaserIsBlind) {
  for (const float says : {std::numeric_limits<float>::quiet_NaN(), 0.0F}) {  // a covered or failed scanner: zeros
    SCOPED_TRACE(says);
    Rehearsal world;
    world.box(-3, -5, 40, 5);
    world.drive_to({{2, 0}, {4, 0}, {8, 0}, {30, 0}});
    world.blind_from = -1.5;
    world.blind_to = 1.5;
    world.blind_range = says;
    world.run(10);
    EXPECT_LT(world.driven, 0.3);
    EXPECT_EQ(world.velocity.linear, 0.0);
  }
}

TEST(Avoider, StandsWhenTheTactileRingThatWasThereFallsSilent) {
  Rehearsal world;
  world.box(-3, -5, 40, 5);
  world.drive_to({{2, 0}, {4, 0}, {8, 0}, {30, 0}});
  for (int i = 0; i < 25; ++i) {
    world.run(0.2);
    world.avoider.add_tactile(world.now, world.now, {});
  }
  ASSERT_GT(world.velocity.linear, 0.5);
  world.run(3.0);
  EXPECT_EQ(world.velocity.linear, 0.0);
  EXPECT_EQ(world.decision.reason, "the tactile ring is silent");
  for (int i = 0; i < 25; ++i) {
    world.run(0.2);
    world.avoider.add_tactile(world.now, world.now, {});
  }
  EXPECT_GT(world.velocity.linear, 0.5);
}

TEST(Avoider, StandsWhenTwoSonarsSideBySideFallSilentButNotForOne) {
  AvoiderParams params;
  params.needs_sonar = true;
  Rehearsal world{1, params};
  world.box(-3, -5, 40, 5);
  world.drive_to({{2, 0}, {4, 0}, {8, 0}, {30, 0}});
  const auto run = [&](double duration, auto is_silent) {
    for (double t = 0.0; t < duration; t += 0.4) {
      for (std::size_t i = 0; i < 24; ++i) {
        const Pose2 mount{0.0, 0.0, Angle::degrees(15.0 * static_cast<double>(i))};
        if (!is_silent(i)) world.avoider.add_sonar(world.now, i, {world.now, mount, 0.26, 5.0, 5.0});
      }
      world.run(0.4);
    }
  };
  run(4.0, [](std::size_t) { return false; });
  run(4.0, [](std::size_t i) { return i == 7 || i == 23; });
  EXPECT_GT(world.velocity.linear, 0.5);
  run(4.0, [](std::size_t i) { return i == 0 || i == 23; });
  EXPECT_EQ(world.velocity.linear, 0.0);
  EXPECT_EQ(world.decision.reason, "no fresh sonar reading of number 23 and the next");
}

TEST(Avoider, VirtualMeasurementsThatAreNoNumbersAreNone) {
  Rehearsal world;
  world.box(-3, -5, 40, 5);
  world.drive_to({{2, 0}, {4, 0}, {8, 0}, {30, 0}});
  world.run(5);
  ASSERT_GT(world.velocity.linear, 0.5);
  world.virtual_is_nan = true;
  world.run(3);
  EXPECT_EQ(world.velocity.linear, 0.0);
  EXPECT_NE(world.decision.reason.find("virtual"), std::string::npos);
}

TEST(Avoider, GetsFreeFromInsideAMargin) {
  Rehearsal world;
  world.box(-3, -3, 6, 3);
  world.map_from_base = {0.0, -3.0 + world.limits.radius + 0.04, Angle::degrees(-20)};  // nose to the wall
  world.drive_to({{3, 0}});
  EXPECT_TRUE(world.run_until_arrived(40)) << world.map_from_base.x << "," << world.map_from_base.y;
  EXPECT_GT(world.least_wall, 0.015);
}

TEST(Avoider, GetsFreeWhenTheHazardsJumpNearer) {
  Rehearsal world;
  world.box(-3, -3, 6, 3);
  world.drive_to({{3, 1}});
  world.hazards = sides({{-1.0, -2}, {2.0, -2}, {2.0, -0.3}, {-1.0, -0.3}});  // 3.5 cm from the outline
  EXPECT_TRUE(world.run_until_arrived(40)) << world.map_from_base.x << "," << world.map_from_base.y;
  EXPECT_GT(world.least_wall, 0.01);
}

TEST(Avoider, SlidesOutOfAMarginThatShutsTheWayAhead) {
  Rehearsal world;
  world.box(-3, -4, 8, 4);
  world.hazards = {{{-2, -0.40}, {5, -0.42}}, {{-2, 0.52}, {5, 0.50}}};  // comes nearer on the way, 0.92 m wide
  world.drive_to({{1, 0.0}, {2, 0.0}, {3, 0.0}, {6, 0.0}});
  world.run(30);
  EXPECT_GT(world.map_from_base.x, 2.0);
  EXPECT_GT(world.least_wall, 0.1);
}

TEST(Avoider, LeavesWhoTouchedItAwayFromThemOnly) {
  for (const bool from_behind : {true, false}) {
    Rehearsal world{5};
    world.box(-3, -5, 15, 5);
    world.drive_to({{1, 0}, {2, 0}, {4, 0}, {8, 0}, {12, 0}});
    world.run(1.0);
    std::vector<std::uint8_t> segments(24, 0);
    segments[from_behind ? 12 : 0] = 1;
    world.avoider.add_tactile(world.now, world.now, segments, 1);
    const auto reflex = world.avoider.reflex(world.now);
    ASSERT_TRUE(reflex);
    EXPECT_EQ(reflex->command, Velocity{}) << "it stands at once, wherever it was touched";
    world.run(1.2);
    if (from_behind)
      EXPECT_GT(world.velocity.linear, 0.1);
    else
      EXPECT_LT(world.velocity.linear, 0.05);
  }
}

TEST(Avoider, NeverTouchesAnythingInRandomClutter) {
  double driven = 0.0;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng{seed};
    Rehearsal world{seed};
    world.noise = 0.03;
    world.box(-4, -4, 12, 4);
    for (int i = 0; i < 14; ++i) {
      const Point2 corner{rng.uniform(1.0, 11.0), rng.uniform(-4.0, 4.0)};
      const double size = rng.uniform(0.1, 0.8);
      world.box(corner.x, corner.y, corner.x + size, corner.y + size);
    }
    world.drive_to({{3, rng.uniform(-2, 2)}, {6, rng.uniform(-2, 2)}, {10, rng.uniform(-2, 2)}});
    world.run_until_arrived(30);
    EXPECT_GT(world.least_wall, 0.0);
    driven += world.driven;
  }
  EXPECT_GT(driven, 150.0);
}

}  // namespace
}  // namespace docent
