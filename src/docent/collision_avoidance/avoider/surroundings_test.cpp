#include "docent/collision_avoidance/avoider/surroundings.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "docent/collision_avoidance/avoider/avoider.h"
#include "docent/collision_avoidance/avoider/rehearsal_for_test.h"

namespace docent::collision_avoidance::surroundings_test {
namespace {

TEST(Surroundings, NobodyIsInsideTheRobot) {
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

TEST(Surroundings, StopsBeforeWhatOnlyACameraSees) {
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

TEST(Surroundings, WithOneLaserInFrontItTurnsAndLooksBeforeItDrives) {
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

TEST(Surroundings, WithOneLaserInFrontItDrivesAheadAsWithTwo) {
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

TEST(Surroundings, ARobotWithoutLasersTakesNoPlaceForUnknown) {
  for (const bool has_lasers : {true, false}) {
    const Surroundings surroundings{{}, {.has_lasers = has_lasers}, {}};
    const auto things = surroundings.obstacles({}, time_from_seconds(10.0), 0.3,
                                               PeopleCaution{{}, 0.08, {}, UnseenBodies{{}, 0.38}, false});
    EXPECT_EQ(things.empty(), !has_lasers) << "what no laser looks at is unknown, unless sonars look all round";
  }
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
    for (int i = 0; i < static_cast<int>(field); ++i) {
      noise = noise * 1664525U + 1013904223U;
      sweep.ranges.push_back(range(Angle::degrees(i - 0.5 * field)) - 0.001F * static_cast<float>(noise >> 29U));
    }
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
  std::uint32_t noise = 1;  ///< no two sweeps of a laser are the same
};

TEST_F(LongBody, BrakesATurnForWhatComesBesideIt) {
  target.mode = AvoiderTarget::Mode::turn;
  target.heading = Angle::degrees(170);
  const auto nothing = [](Angle) { return 9.0F; };
  for (int i = 0; i < 20; ++i) {
    cycle(nothing);
    if (i % 5 == 0) (void)avoider->decide(now);
    turn();
  }
  ASSERT_GT(avoider->command().angular, 0.5);
  const auto post = [](Angle bearing) {  // just left of the front left corner, which turns to it
    return std::abs(bearing.degrees() - 45.0) < 3.0 ? 0.45F : 9.0F;
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
      cycle([](Angle) { return 9.0F; }, field);
      if (i == 19) (void)avoider->decide(now);
    }
    return avoider->command().angular;
  };
  EXPECT_GT(command_of(360.0), 0.3);
  EXPECT_LT(command_of(180.0), 0.1) << "its tail would sweep what is behind";
}

TEST_F(LongBody, WhatTouchesItOrCannotBeSeenLiesAtItsEdge) {
  const auto blind_to_the_left = [](Angle bearing) {
    return std::abs(bearing.degrees() - 90.0) < 10.0 ? std::numeric_limits<float>::quiet_NaN() : 9.0F;
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
    return aside > 0.11 ? static_cast<float>(0.5 / aside) : 9.0F;
  };
  for (int i = 0; i < 4; ++i) cycle(wall);
  const auto decision = avoider->decide(now);
  EXPECT_NEAR(decision.nearest_real, 0.3, 0.01);
  // Who has not moved yet is as slow as this: its laser is not borne out.
  EXPECT_GE(decision.speed_cap, ScannerWatchParams{}.unproven_speed) << decision.reason;
}

TEST(Surroundings, DoesNotDriveWhereTheLaserIsBlind) {
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

}  // namespace
}  // namespace docent::collision_avoidance::surroundings_test
