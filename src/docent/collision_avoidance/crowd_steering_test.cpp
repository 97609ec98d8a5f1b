#include "docent/collision_avoidance/crowd_steering.h"

#include <gtest/gtest.h>

#include "docent/collision_avoidance/rehearsal_for_test.h"

namespace docent {
namespace {

const std::vector<Point2> kPath{{0.0, 0.0}, {1.5, 0.0}, {3.0, 0.0}};
constexpr double kCap = 0.7;

/// The visible side of somebody's body.
void add_person(std::vector<Obstacle>& obstacles, Point2 centre, Point2 velocity = {}) {
  const Angle back = direction(centre, {});
  for (int i = -3; i <= 3; ++i)
    obstacles.push_back({centre + 0.22 * unit(back + Angle::degrees(25.0 * i)), velocity, 0.08, true, false});
}
void add_wall(std::vector<Obstacle>& obstacles, Point2 from, Point2 to) {
  const double length = distance(from, to);
  for (double along = 0.0; along < length; along += 0.05)
    obstacles.push_back({from + (along / length) * (to - from), {}, 0.08, false, false});
}
CrowdAdvice steer(std::span<const Obstacle> obstacles, double speed = 0.0) {
  CrowdSteering steering{{}, {}};
  return steering.steer({{}, {speed, 0.0}}, obstacles, {kPath, false}, kCap, 0.25);
}

TEST(CrowdSteering, GoesStraightOnInTheOpen) {
  const CrowdAdvice advice = steer({});
  EXPECT_NEAR(advice.bearing, 0.0, 0.07);
  EXPECT_DOUBLE_EQ(advice.speed, kCap);
}

TEST(CrowdSteering, PassesWhoStandsInTheWayOnTheOpenSide) {
  for (const double side : {1.0, -1.0}) {
    std::vector<Obstacle> obstacles;
    add_person(obstacles, {1.3, 0.0});
    add_person(obstacles, {1.3, 0.8 * side});
    add_wall(obstacles, {0.0, 1.4 * side}, {3.0, 1.4 * side});
    const CrowdAdvice advice = steer(obstacles, 0.4);
    EXPECT_LT(advice.bearing * side, -0.1);
    EXPECT_FALSE(advice.waits);
  }
}

TEST(CrowdSteering, GoesStraightOnBehindWhoWillBeGone) {
  std::vector<Obstacle> crossing;
  add_person(crossing, {1.6, 0.2}, {0.0, 1.2});
  EXPECT_NEAR(steer(crossing, 0.6).bearing, 0.0, 0.2);
  EXPECT_GT(steer(crossing, 0.6).speed, 0.3);
  std::vector<Obstacle> stands;
  add_person(stands, {1.6, 0.2});
  EXPECT_LT(steer(stands, 0.6).bearing, -0.1) << "who stays is passed on the other side";
}

TEST(CrowdSteering, DrivesTailFirstRatherThanTurnRound) {
  CrowdSteering steering{{}, {}};
  const std::vector<Point2> back{{0.0, 0.0}, {-1.5, 0.0}, {-3.0, 0.0}};
  const CrowdAdvice advice = steering.steer({}, {}, {back, false}, kCap, 0.25);
  EXPECT_TRUE(advice.tail_first);
  EXPECT_NEAR(advice.bearing, 0.0, 0.1);
  EXPECT_GT(advice.speed, 0.3);
}

TEST(CrowdSteering, RemembersWhoStandsBehindSomebody) {
  CrowdSteering steering{{}, {}};
  std::vector<Obstacle> row;
  for (double y = -3.0; y < 1.0; y += 0.5) add_person(row, {2.2, y});
  for (int i = 0; i < 12; ++i) (void)steering.steer({}, row, {kPath, true}, kCap, 0.25);
  // Two step between: the row is out of sight behind them, and still there.
  std::vector<Obstacle> hidden;
  for (double y = -0.9; y < 0.5; y += 0.1) hidden.push_back({{0.9, y}, {0.0, 0.9}, 0.08, true, false});
  (void)steering.steer({}, hidden, {kPath, true}, kCap, 0.25);
  EXPECT_GT(steering.field().cost(steering.field().layers(), {2.0, 0.0}), 5.0);
  CrowdSteering forgetful{{}, {}};
  (void)forgetful.steer({}, hidden, {kPath, true}, kCap, 0.25);
  EXPECT_LT(forgetful.field().cost(forgetful.field().layers(), {2.0, 0.0}), 5.0);
}

TEST(CrowdSteering, NeverSteersIntoAThing) {
  int moved = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Rng rng{seed};
    std::vector<Obstacle> obstacles;
    for (int i = 0; i < 12; ++i) {
      const Point2 at{rng.uniform(-2.5, 3.0), rng.uniform(-2.5, 2.5)};
      if (norm(at) > 0.85) add_person(obstacles, at);
    }
    const CrowdAdvice advice = steer(obstacles);
    if (advice.waits) continue;
    ++moved;
    const double bearing = advice.bearing + (advice.tail_first ? 3.14159265 : 0.0);
    EXPECT_GT(straight_free_way(bearing, obstacles, BaseLimits{}.radius - 0.08, 1.0), 0.2) << "seed " << seed;
  }
  EXPECT_GT(moved, 40);
}

TEST(CrowdSteering, CrossesAHallOfPeopleWhoIgnoreItWithoutPushing) {
  int arrived = 0;
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    AvoiderParams params = Rehearsal::without_sonar();
    params.method = "crowd_fit";
    Rehearsal world{seed, params};
    world.box(-2, -5, 14, 5);
    world.drive_to({{1, 0}, {2, 0}, {3, 0}, {4, 0}, {5, 0}, {6, 0}, {7, 0}, {8, 0}, {9, 0}, {10, 0}});
    Rng rng{seed + 100};
    for (int i = 0; i < 30; ++i) {
      const Point2 place{rng.uniform(1.0, 12.0), rng.uniform(-20.0, 20.0)};
      world.people.push_back({place, {rng.uniform(-0.2, 0.2), place.y > 0.0 ? -0.8 : 0.8}});
    }
    arrived += world.run_until_arrived(60.0) ? 1 : 0;
    EXPECT_LE(world.worst_push, 0.1) << "seed " << seed;
  }
  EXPECT_GE(arrived, 1);
}

}  // namespace
}  // namespace docent
