#include "docent/collision_avoidance/avoider/avoider.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "docent/collision_avoidance/avoider/rehearsal_for_test.h"
#include "docent/collision_avoidance/local_planner/testing.h"

namespace docent::collision_avoidance::avoider_test {
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
  EXPECT_LT(world.velocity.linear, ComplaintParams{}.crippled_speed + 0.01);
  EXPECT_NEAR(static_cast<double>(world.avoider.memory().points(world.now).size()), static_cast<double>(known),
              0.25 * static_cast<double>(known));
  world.run(5.0);
  EXPECT_GT(world.velocity.linear, 0.5);
  EXPECT_NEAR(world.map_from_base.y, 0.0, 0.1) << "targets are carried over the jump";
}

/// A furnished hall in which the robot drives fast, and somebody carries it off.
class CarriedAway : public ::testing::Test {
 protected:
  CarriedAway() {
    world.box(-3, -5, 40, 5);
    for (const double x : {6.0, 13.0, 21.0}) world.people.push_back({{x, 2.5}});
    world.walls.push_back({{16, -5}, {16, -2}});
    world.checks_choices = true;
    world.drive_to({{2, 0}, {4, 0}, {8, 0}, {30, 0}});
    world.run(5);
  }
  /// Its wheels do not notice.
  void carry_to(const Pose2& place) {
    world.raw_from_map = world.raw_from_map * world.map_from_base * inverse(place);
    world.map_from_base = place;
  }
  void believe(bool says_here) {
    const BelievedPose pose{world.map_from_base, 1.0};
    world.avoider.add_belief({{&pose, 1}, {&pose, 1}, says_here ? 0.001 : 0.9, says_here});
    world.avoider.add_place(world.now, world.now, pose.map_from_robot, world.raw_from_map * world.map_from_base, 1.0);
  }
  Rehearsal world;
};

TEST_F(CarriedAway, ItStopsWithinHalfASecondAndTurnsOnlyUntilItKnowsWhereItIs) {
  ASSERT_GT(world.velocity.linear, 0.5);
  EXPECT_EQ(world.avoider.times_carried_off(), 0U);
  carry_to({33, -3, Angle::degrees(130)});
  world.run(0.3);
  EXPECT_EQ(world.avoider.command().linear, 0.0);
  EXPECT_EQ(world.avoider.times_carried_off(), 1U);
  world.run(3.0);
  const Pose2 here = world.map_from_base;
  world.target.mode = AvoiderTarget::Mode::turn;
  world.target.heading = here.theta + Angle::degrees(120);
  world.run(1.0);
  EXPECT_GT(std::abs(world.velocity.angular), 0.5) << world.decision.reason;
  world.target.mode = AvoiderTarget::Mode::drive;
  for (int i = 0; i < 6; ++i) {
    believe(false);
    world.run(0.5);
  }
  EXPECT_LT(distance(world.map_from_base.position(), here.position()), 0.05);
  for (int i = 0; i < 4; ++i) {
    believe(true);
    world.run(0.5);
  }
  EXPECT_FALSE(world.avoider.is_carried_off());
  world.run(2.0);
  EXPECT_GT(world.velocity.linear, 0.2) << world.decision.reason;
}

TEST_F(CarriedAway, ARobotThatMissesItDrivesOn) {
  AvoiderParams params = Rehearsal::without_sonar();
  params.stops_when_carried_off = false;
  Rehearsal other{1, params};
  other.walls = world.walls;
  other.drive_to({{2, 0}, {4, 0}, {8, 0}, {30, 0}});
  other.run(5);
  other.raw_from_map = other.map_from_base * inverse(Pose2{33, -3, Angle::degrees(130)});
  other.map_from_base = {33, -3, Angle::degrees(130)};
  other.run(0.3);
  EXPECT_GT(other.avoider.command().linear, 0.3);
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

TEST(Avoider, ASweepThatWasOvertakenHidesNothing) {
  Rehearsal world;
  world.box(-3, -3, 6, 3);
  world.run(1.0);
  const auto nearest_ahead = [&] {
    double nearest = 10.0;
    for (const auto& point : world.avoider.memory().points(world.now)) nearest = std::min(nearest, norm(point.in_odom));
    return nearest;
  };
  EXPECT_NEAR(nearest_ahead(), 3.0, 0.1);
  SensorSweep near{world.now - seconds(0.15), {}, -0.5, 0.02, 0.02, 10.0, std::vector<float>(50, 1.0F)};
  world.avoider.add_sweep(world.now, 0, near);
  EXPECT_NEAR(nearest_ahead(), 3.0, 0.1) << "it is of before";
  near.stamp = near.stamp + seconds(0.01);
  world.avoider.add_sweep(world.now, 0, near);
  EXPECT_NEAR(nearest_ahead(), 1.0, 0.1) << "two in succession: the clock was set back";
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

TEST(Avoider, NeverTouchesAnythingInRandomClutter) {
  AvoiderParams params = Rehearsal::without_sonar();
  params.body = {.ahead = 0.0, .aside = 0.0};  // clutter has no legs
  double driven = 0.0;
  for (std::uint64_t seed = 0; seed < 15; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng{seed};
    Rehearsal world{seed, params};
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

/// A hall with a wall 4 m before the robot, whose path leads through it.
struct HeadlongTest : ::testing::Test {
  Rehearsal drive(const Velocity& wish, double duration, const std::vector<RehearsalPerson>& people = {}) {
    Rehearsal world{1, Rehearsal::without_sonar(), {"front laser", "rear laser"}, testing::headlong(wish, &log)};
    world.checks_choices = true;
    world.people = people;
    world.box(-3, -3, 4, 3);
    world.drive_to({{1, 0}, {2, 0}, {8, 0}});
    world.run(duration);
    return world;
  }
  testing::HeadlongLog log;
};

TEST_F(HeadlongTest, APlannerThatDrivesIntoAWallIsStoppedBeforeIt) {
  for (const double wish : {10.0, 0.5, 0.1, 0.02}) {
    const double needed = 4.0 / std::min(wish, 0.7);
    const Rehearsal world = drive({wish, 0.0}, needed + 10.0);
    EXPECT_GT(world.least_wall, 0.0) << "at " << wish << " m/s";
    EXPECT_GT(world.driven, 3.0) << "it is the planner that drives";
    EXPECT_LT(world.velocity.linear, 0.02);
    EXPECT_EQ(world.decision.command, Velocity{});
    EXPECT_GT(log.asked, 4 * static_cast<int>(needed)) << "and is asked again";
  }
  EXPECT_EQ(log.path, 3U);
  EXPECT_GT(log.carrot.x, 0.5);
}

TEST_F(HeadlongTest, APlannerThatSeesNobodyPushesNobody) {
  EXPECT_LE(drive({0.7, 0.0}, 10.0, {{{2.5, 0.05}}}).worst_push, 0.0) << "who stands";
  EXPECT_LE(drive({0.7, 0.0}, 10.0, {{{3.5, 0.1}, {-0.9, 0.0}}}).worst_push, 0.1) << "who comes";
}

TEST_F(HeadlongTest, DrivesNoFasterThanIsAllowedAndNothingThatIsNoNumber) {
  EXPECT_LT(drive({10.0, 0.0}, 5.0).top_speed, 0.71);
  EXPECT_GT(drive({-10.0, 0.0}, 3.0).map_from_base.x, -0.5) << "backwards it creeps";
  EXPECT_EQ(drive({std::nan(""), 0.0}, 3.0).driven, 0.0);
  EXPECT_EQ(drive({0.3, std::numeric_limits<double>::infinity()}, 3.0).driven, 0.0);
  const Rehearsal turning = drive({0.0, 50.0}, 3.0);
  EXPECT_LE(turning.velocity.angular, turning.limits.max_turn_rate + 1e-6);
  EXPECT_GT(turning.velocity.angular, 1.0);
}

TEST_F(HeadlongTest, IsNotAskedWhileTheRobotMustStand) {
  Rehearsal world = drive({0.5, 0.0}, 1.0);
  const int asked = log.asked;
  EXPECT_GT(asked, 0);
  world.avoider.stop_by_hand(true);
  const int forgot = log.forgot;
  world.run(1.0);
  EXPECT_EQ(log.asked, asked);
  EXPECT_GT(log.forgot, forgot);
  EXPECT_EQ(world.decision.command, Velocity{});
}

}  // namespace
}  // namespace docent::collision_avoidance::avoider_test
