#include "docent/collision_avoidance/obstacle_field/obstacle_memory.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace docent::collision_avoidance::obstacle_memory_test {
namespace {

constexpr double kBeam = std::numbers::pi / 180.0;

SensorSweep sweep_at(double time, float range = 10.0F) {
  SensorSweep sweep{time_from_seconds(time), {}, -0.5 * std::numbers::pi, kBeam, 0.05, 10.0, {}};
  sweep.ranges.assign(181, range);
  return sweep;
}
void put(SensorSweep& sweep, int from, int to, float range) {
  for (int i = from; i <= to; ++i) sweep.ranges[static_cast<std::size_t>(i)] = range;
}

TEST(ObstacleMemory, KeepsPointsInTheOdometryFrame) {
  ObstacleMemory memory;
  auto sweep = sweep_at(1.0);
  put(sweep, 88, 92, 2.0F);
  memory.add_sweep(0, sweep, {1.0, 1.0, Angle::degrees(90)});
  const auto points = memory.points(time_from_seconds(1.0));
  ASSERT_EQ(points.size(), 5U);
  EXPECT_NEAR(points[2].in_odom.x, 1.0, 1e-6);
  EXPECT_NEAR(points[2].in_odom.y, 3.0, 1e-6);
}

TEST(ObstacleMemory, ALoneReadingCountsFromTheSecondSweepOn) {
  ObstacleMemory memory;
  auto sweep = sweep_at(1.0);
  put(sweep, 90, 90, 1.0F);
  memory.add_sweep(0, sweep, {});
  EXPECT_TRUE(memory.points(time_from_seconds(1.0)).empty());
  sweep.stamp = time_from_seconds(1.1);
  memory.add_sweep(0, sweep, {});
  EXPECT_EQ(memory.points(time_from_seconds(1.1)).size(), 1U);
  for (const double time : {1.2, 1.3, 1.4}) memory.add_sweep(0, sweep_at(time), {});
  EXPECT_TRUE(memory.points(time_from_seconds(1.4)).empty());  // seen through
}

TEST(ObstacleMemory, WhatOneBeamMissesIsStillOfTheLastThreeSweeps) {
  ObstacleMemory memory;
  auto leg = sweep_at(1.0);
  put(leg, 90, 91, 1.0F);
  memory.add_sweep(0, leg, {});
  for (const double time : {1.1, 1.2}) {
    memory.add_sweep(0, sweep_at(time), {});
    EXPECT_EQ(memory.points(time_from_seconds(time)).size(), 2U) << time;
  }
  leg.stamp = time_from_seconds(1.3);
  memory.add_sweep(0, leg, {});
  EXPECT_EQ(memory.points(time_from_seconds(1.3)).size(), 2U);  // met again: not twice
  for (const double time : {1.4, 1.5, 1.6}) memory.add_sweep(0, sweep_at(time), {});
  EXPECT_TRUE(memory.points(time_from_seconds(1.6)).empty());
}

TEST(ObstacleMemory, InfraredSeesWhatTheLasersLookOver) {
  ObstacleMemory memory;
  memory.add_sweep(0, sweep_at(0.9), {});
  const SonarReading low{time_from_seconds(1.0), {0.25, 0.0, {}}, 0.09, 0.8, 0.4};
  memory.add_infrared(0, low, {});
  EXPECT_TRUE(memory.points(time_from_seconds(1.0)).empty());
  SonarReading again = low;
  again.stamp = time_from_seconds(1.2);
  memory.add_infrared(0, again, {});
  const auto points = memory.points(time_from_seconds(1.2));
  ASSERT_EQ(points.size(), 3U);
  EXPECT_NEAR(points[1].in_odom.x, 0.65, 1e-9);
  SonarReading nothing = low;
  nothing.range = 0.8;
  for (const double time : {2.0, 2.2, 3.0}) {
    nothing.stamp = time_from_seconds(time);
    memory.add_infrared(1, nothing, {});
  }
  EXPECT_TRUE(memory.points(time_from_seconds(3.0)).empty());
}

TEST(ObstacleMemory, ACamerasLinesCountForTheirLifetimeAndUntilItsNextPicture) {
  ObstacleMemory memory;
  const std::vector<Segment> step{{{1.0, -0.5}, {1.0, 0.5}}};
  const Pose2 odom_from_base{2.0, 0.0, Angle::degrees(90)};
  memory.add_lines("front", time_from_seconds(1.0), 2.0, step, odom_from_base);
  memory.add_lines("rear", time_from_seconds(1.0), 1.0, step, {});
  const auto points = memory.points(time_from_seconds(1.5));
  ASSERT_GE(points.size(), 2U * 21U);
  for (std::size_t i = 0; i < points.size() / 2; ++i) {
    EXPECT_NEAR(points[i].in_odom.y, 1.0, 1e-9);
    EXPECT_NEAR(points[i].in_odom.x, 2.5 - ObstacleMemoryParams{}.line_step * static_cast<double>(i), 0.06);
  }
  EXPECT_EQ(memory.points(time_from_seconds(2.5)).size(), points.size() / 2);
  EXPECT_TRUE(memory.points(time_from_seconds(3.1)).empty());
  memory.add_lines("front", time_from_seconds(1.6), 2.0, {}, odom_from_base);
  EXPECT_EQ(memory.points(time_from_seconds(1.7)).size(), points.size() / 2);
  memory.add_lines("front", time_from_seconds(2.0), 1e9, step, odom_from_base);
  EXPECT_TRUE(memory.points(time_from_seconds(8.0)).empty());  // for ever is too long
}

TEST(ObstacleMemory, RemembersWhatANewSweepCannotSee) {
  ObstacleMemory memory;
  auto sweep = sweep_at(1.0);
  put(sweep, 85, 95, 2.0F);
  memory.add_sweep(0, sweep, {});
  auto occluded = sweep_at(1.1);
  put(occluded, 80, 100, 1.0F);
  memory.add_sweep(0, occluded, {});
  EXPECT_EQ(memory.points(time_from_seconds(1.1)).size(), 21U + 11U);
  auto blind = sweep_at(1.2, std::nanf(""));
  memory.add_sweep(0, blind, {});
  EXPECT_EQ(memory.points(time_from_seconds(1.2)).size(), 21U + 11U);
  EXPECT_GT(memory.blind_directions().size(), 170U);
  EXPECT_EQ(memory.invalid_share(0), 1.0);
  EXPECT_TRUE(memory.points(time_from_seconds(2.8)).empty());  // but not for ever
}

TEST(ObstacleMemory, ScatteredInvalidReadingsAreNotBlindness) {
  ObstacleMemory memory;
  auto sweep = sweep_at(1.0, 3.0F);
  for (std::size_t i = 0; i < sweep.ranges.size(); i += 2) sweep.ranges[i] = std::nanf("");
  memory.add_sweep(0, sweep, {});
  EXPECT_TRUE(memory.blind_directions().empty());
  EXPECT_NEAR(memory.invalid_share(0), 0.5, 0.01);
}

TEST(ObstacleMemory, ThePostsOfTheRobotAreNoBlindness) {
  ObstacleMemory memory;
  auto sweep = sweep_at(1.0, 3.0F);
  put(sweep, 20, 40, std::nanf(""));
  put(sweep, 100, 120, std::nanf(""));
  sweep.own_body.resize(sweep.ranges.size());
  for (std::size_t i = 20; i <= 40; ++i) sweep.own_body[i] = true;
  memory.add_sweep(0, sweep, {});
  EXPECT_EQ(memory.blind_directions().size(), 21U) << "the other gap is";
  EXPECT_NEAR(memory.invalid_share(0), 21.0 / static_cast<double>(sweep.ranges.size()), 1e-9);
}

TEST(ObstacleMemory, FindsAFrozenLaserOnlyWhenTheBaseMoves) {
  ObstacleMemory memory;
  auto sweep = sweep_at(0.0, 3.0F);
  for (int i = 0; i < 20; ++i) {
    sweep.stamp = time_from_seconds(0.1 * i);
    memory.add_sweep(0, sweep, {});
  }
  EXPECT_FALSE(memory.is_frozen(0));
  for (int i = 20; i < 25; ++i) {
    sweep.stamp = time_from_seconds(0.1 * i);
    memory.add_sweep(0, sweep, {0.02 * (i - 19), 0.0, {}});
  }
  EXPECT_TRUE(memory.is_frozen(0));
  put(sweep, 0, 0, 2.99F);
  memory.add_sweep(0, sweep, {0.2, 0.0, {}});
  EXPECT_FALSE(memory.is_frozen(0));
}

TEST(ObstacleMemory, AHandfulOfReadingsProvesThatALaserIsFrozen) {
  for (const int hits : {2, 3, 5}) {
    SCOPED_TRACE(hits);
    ObstacleMemory memory;
    auto sweep = sweep_at(0.0);
    put(sweep, 90, 90 + hits - 1, 3.0F);
    const auto drive = [&](int from, int to) {
      for (int i = from; i < to; ++i) {
        sweep.stamp = time_from_seconds(0.1 * i);
        memory.add_sweep(0, sweep, {0.03 * i, 0.0, {}});
      }
    };
    drive(0, 2);
    EXPECT_FALSE(memory.is_frozen(0)) << "one repeat may be chance";
    drive(2, 6);
    EXPECT_EQ(memory.is_frozen(0), hits >= 3);
    put(sweep, 90, 90, 2.99F);
    drive(6, 7);
    EXPECT_FALSE(memory.is_frozen(0));
  }
}

TEST(ObstacleMemory, OpenSpaceIsNoFrozenLaser) {
  ObstacleMemory memory;
  for (int i = 0; i < 20; ++i) memory.add_sweep(0, sweep_at(0.1 * i), {0.1 * i, 0.0, {}});
  EXPECT_FALSE(memory.is_frozen(0));
}

TEST(ObstacleMemory, SonarCountsWhenConfirmedAndUnexplained) {
  ObstacleMemory memory;
  memory.add_sweep(0, sweep_at(0.9), {});
  const SonarReading glass{time_from_seconds(1.0), {0.25, 0.0, {}}, 0.26, 5.0, 0.75};
  memory.add_sonar(0, glass, {});
  EXPECT_TRUE(memory.points(time_from_seconds(1.0)).empty());
  SonarReading again = glass;
  again.stamp = time_from_seconds(1.4);
  memory.add_sonar(0, again, {});
  const auto points = memory.points(time_from_seconds(1.4));
  ASSERT_EQ(points.size(), 3U);
  EXPECT_NEAR(points[1].in_odom.x, 1.0, 1e-9);

  ObstacleMemory other;
  auto wall = sweep_at(0.9);
  put(wall, 88, 92, 1.0F);
  other.add_sweep(0, wall, {});
  other.add_sonar(0, glass, {});
  other.add_sonar(0, again, {});
  for (const auto& point : other.points(time_from_seconds(1.4))) EXPECT_EQ(point.seen, time_from_seconds(0.9));
}

TEST(MovingObjects, FollowsAWalkerAndLeavesAStanderAlone) {
  ObstacleMemory memory;
  const auto view = [](double time, Point2 walker, Point2 stander) {
    auto sweep = sweep_at(time);
    for (int i = 0; i < 181; ++i) {
      const Point2 direction = unit(Angle::radians(sweep.first_bearing + i * kBeam));
      for (const Point2 centre : {walker, stander}) {
        const double along = dot(direction, centre);
        const double aside = std::abs(cross(direction, centre));
        if (along < 0.0 || aside >= 0.2) continue;
        sweep.ranges[static_cast<std::size_t>(i)] = static_cast<float>(along - std::sqrt(0.04 - aside * aside));
      }
    }
    return sweep;
  };
  Point2 walker{3.0, -1.0};
  for (int i = 0; i < 12; ++i) {
    memory.add_sweep(0, view(0.1 * i, walker, {2.0, 1.0}), {});
    walker = walker + Point2{-0.08, 0.04};
  }
  int moving = 0;
  int standing = 0;
  for (const auto& point : memory.points(time_from_seconds(1.1))) {
    if (point.seen != time_from_seconds(1.1)) continue;
    EXPECT_TRUE(point.person);
    if (point.in_odom.y < 0.5) {
      EXPECT_NEAR(point.velocity.x, -0.8, 0.2);
      EXPECT_NEAR(point.velocity.y, 0.4, 0.2);
      ++moving;
    } else {
      EXPECT_EQ(point.velocity, Point2{});
      ++standing;
    }
  }
  EXPECT_GT(moving, 3);
  EXPECT_GT(standing, 3);
}

TEST(ObstacleMemory, ATouchOfWhatALaserSeesIsForTheLaserToFollow) {
  const auto touched = [](bool is_seen, double time) {
    ObstacleMemory memory;
    auto sweep = sweep_at(1.0);
    if (is_seen) put(sweep, 80, 100, 0.3F);  // somebody before the body, whose edge is 0.265 m off
    memory.add_sweep(0, sweep, {});
    memory.add_touch(time_from_seconds(1.0), {0.265, 0.0}, {});
    for (int i = 1; 1.0 + 0.1 * i <= time; ++i) memory.add_sweep(0, sweep_at(1.0 + 0.1 * i), {});  // they are gone
    const auto points = memory.points(time_from_seconds(time));
    return std::any_of(points.begin(), points.end(),
                       [](const ObstaclePoint& point) { return std::abs(point.in_odom.x - 0.265) < 1e-6; });
  };
  EXPECT_TRUE(touched(true, 1.2));
  EXPECT_FALSE(touched(true, 1.5));
  EXPECT_TRUE(touched(false, 30.0)) << "nothing but the touch tells of it";
  EXPECT_FALSE(touched(false, 61.1));
}

TEST(ObstacleMemory, WhatTouchesBesideSomebodyMayBeThem) {
  ObstacleMemory memory;
  auto sweep = sweep_at(1.0);
  put(sweep, 80, 100, 0.55F);  // somebody who has come nearer since
  memory.add_sweep(0, sweep, {});
  memory.add_touch(time_from_seconds(1.0), {0.265, 0.0}, {});
  EXPECT_TRUE(memory.touched_things(time_from_seconds(1.0)).empty());
  memory.add_touch(time_from_seconds(1.0), {-0.265, 0.0}, {});
  EXPECT_EQ(memory.touched_things(time_from_seconds(1.0)).size(), 1U);
}

TEST(ObstacleMemory, NothingThatTouchesIsInsideTheBody) {
  ObstacleMemory memory;
  memory.add_touch(time_from_seconds(1.0), {0.265, 0.0}, {});
  memory.stand({0.02, 0.0}, 0.235);
  EXPECT_EQ(memory.touched_things(time_from_seconds(1.1)).size(), 1U) << "it presses";
  memory.stand({0.2, 0.0}, 0.235);  // the wheels slipped: so far the body cannot have come
  EXPECT_TRUE(memory.touched_things(time_from_seconds(1.2)).empty());
}

TEST(ObstacleMemory, WhoComesOutOfAThrongComesNearerThoughNobodyIsFollowed) {
  ObstacleMemory memory;
  for (int k = 0; k < 6; ++k) {
    const std::vector<Point2> row{{1.8, -0.8}, {1.8, -0.4}, {1.8 - 0.1 * k, 0.0}, {1.8, 0.4}, {1.8, 0.8}};
    auto sweep = sweep_at(0.1 * k);
    for (std::size_t i = 0; i < sweep.ranges.size(); ++i) {
      const Point2 way = unit(Angle::radians(sweep.first_bearing + static_cast<double>(i) * kBeam));
      for (const Point2 person : row) {
        if (const auto hit = ray_distance({}, way, person, 0.22))
          sweep.ranges[i] = std::min(sweep.ranges[i], static_cast<float>(*hit));
      }
    }
    memory.add_sweep(0, sweep, {});
  }
  int coming = 0;
  for (const auto& point : memory.points(time_from_seconds(0.5))) {
    EXPECT_FALSE(point.straight);
    if (std::abs(point.in_odom.y) > 0.12 || point.in_odom.x > 1.4) continue;
    EXPECT_NEAR(point.velocity.x, -1.0, 0.25);
    EXPECT_TRUE(point.person);
    ++coming;
  }
  EXPECT_GT(coming, 5);
}

TEST(MovingObjects, AWallIsNoPersonNorIsAPieceSeenThroughAGap) {
  ObstacleMemory memory;
  auto sweep = sweep_at(1.0, 1.0F);
  put(sweep, 85, 95, 3.0F);  // through a door, a piece of the wall behind
  memory.add_sweep(0, sweep, {});
  for (const auto& point : memory.points(time_from_seconds(1.0))) EXPECT_FALSE(point.person);
}

}  // namespace
}  // namespace docent::collision_avoidance::obstacle_memory_test
