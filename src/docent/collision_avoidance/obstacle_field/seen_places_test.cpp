#include "docent/collision_avoidance/obstacle_field/seen_places.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace docent::collision_avoidance::seen_places_test {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kMargin = 0.08;
const BaseLimits kDisc{};

/// A laser that looks ahead over `field` [deg] and meets something at `range` [m] in every direction.
SensorSweep sweep(double time, double field, float range, const Pose2& base_from_sensor = {}) {
  return {time_from_seconds(time),
          base_from_sensor,
          -0.5 * field * kDegree,
          kDegree,
          0.05,
          10.0,
          std::vector<float>(static_cast<std::size_t>(field), range)};
}

bool has_within(const std::vector<Point2>& places, Point2 at, double reach) {
  return std::any_of(places.begin(), places.end(), [&](Point2 place) { return distance(place, at) < reach; });
}

TEST(SeenPlaces, LasersThatLookAllRoundLeaveNothingUnknown) {
  const auto now = time_from_seconds(1.0);
  SeenPlaces one;
  EXPECT_FALSE(one.unknown({}, kDisc, kMargin, now).empty()) << "nothing was seen yet";
  one.add(0, sweep(1.0, 360.0, 0.3F), {});
  EXPECT_TRUE(one.unknown({}, kDisc, kMargin, now).empty());
  SeenPlaces two;
  two.add(0, sweep(1.0, 180.0, 5.0F), {});
  two.add(1, sweep(1.0, 180.0, 5.0F, {0.0, 0.0, Angle::degrees(180.0)}), {});
  EXPECT_TRUE(two.unknown({}, kDisc, kMargin, now).empty());
  EXPECT_TRUE(two.unknown({2.0, 1.0, Angle::degrees(40.0)}, kDisc, kMargin, now).empty()) << "wherever it is";
}

TEST(SeenPlaces, WhatLiesOutOfViewIsUnknownAndTheBodyCannotPassBetween) {
  SeenPlaces seen;
  seen.add(0, sweep(1.0, 180.0, 2.0F), {});
  const auto places = seen.unknown({}, kDisc, kMargin, time_from_seconds(1.1));
  ASSERT_FALSE(places.empty());
  for (const Point2 place : places) {
    EXPECT_LT(place.x, 0.03);
    EXPECT_GT(kDisc.gap_to(place), kMargin) << "the robot may drive away from it";
  }
  for (int degrees = 95; degrees <= 265; ++degrees) {
    for (const double away : {0.4, 0.6, 1.0, 1.5, 2.0, 2.5})
      EXPECT_TRUE(has_within(places, away * unit(Angle::degrees(degrees)), kDisc.radius + kMargin)) << degrees;
  }
}

/// A laser that looks all round past a post of the robot in `width` beams of a degree to the left.
SensorSweep past_a_post(double time, std::size_t width) {
  SensorSweep result = sweep(time, 360.0, 5.0F);
  result.own_body.resize(360);
  for (std::size_t i = 0; i < width; ++i) {
    result.own_body[270 + i] = true;
    result.ranges[270 + i] = std::nanf("");
  }
  return result;
}

TEST(SeenPlaces, BehindAPostOfTheRobotLiesWhatWasSeenBefore) {
  const auto now = time_from_seconds(1.1);
  SeenPlaces slim;
  slim.add(0, past_a_post(1.0, 5), {});
  EXPECT_TRUE(slim.unknown({}, kDisc, kMargin, now).empty()) << "a leg is wider";
  SeenPlaces wide;
  wide.add(0, past_a_post(1.0, 15), {});
  const auto hidden = wide.unknown({}, kDisc, kMargin, now);
  ASSERT_FALSE(hidden.empty());
  for (const Point2 place : hidden) EXPECT_NEAR(direction({}, place).degrees(), 97.0, 10.0);
  EXPECT_TRUE(has_within(hidden, {-0.3, 2.4}, 0.3)) << "far away likewise";
  const Pose2 turned{0.0, 0.0, Angle::degrees(20.0)};
  wide.add(0, past_a_post(1.3, 15), turned);
  EXPECT_TRUE(wide.unknown(turned, kDisc, kMargin, time_from_seconds(1.4)).empty()) << "it was seen a moment ago";
}

TEST(SeenPlaces, AFreePlaceIsRememberedForAWhileUnlessSomethingWasMetThere) {
  const Pose2 turned{0.0, 0.0, Angle::degrees(180.0)};
  for (const float range : {2.0F, 0.3F}) {
    SeenPlaces seen;
    for (int i = 0; i <= 10; ++i) seen.add(0, sweep(1.0 + 0.1 * i, 180.0, range), {});
    for (int i = 1; i <= 30; ++i) seen.add(0, sweep(2.0 + 0.1 * i, 180.0, range), turned);
    const Point2 behind{-0.4, 0.0};
    EXPECT_EQ(has_within(seen.unknown(turned, kDisc, kMargin, time_from_seconds(4.5)), behind, 0.1), range < 1.0F);
    EXPECT_TRUE(has_within(seen.unknown(turned, kDisc, kMargin, time_from_seconds(5.2)), behind, 0.1))
        << "too long ago";
  }
}

TEST(SeenPlaces, TheLastLookAtAPlaceTells) {
  const Pose2 turned{0.0, 0.0, Angle::degrees(180.0)};
  SeenPlaces seen;
  seen.add(0, sweep(1.0, 180.0, 2.0F), {});
  seen.add(0, sweep(1.3, 180.0, 0.3F), {});  // somebody came
  seen.add(0, sweep(1.6, 180.0, 2.0F), turned);
  EXPECT_TRUE(has_within(seen.unknown(turned, kDisc, kMargin, time_from_seconds(1.7)), {-0.4, 0.0}, 0.1));
}

TEST(SeenPlaces, WhoDrivesAheadKnowsWhatItHasPassed) {
  SeenPlaces seen;
  for (int i = 0; i <= 20; ++i) seen.add(0, sweep(0.1 * i, 180.0, 5.0F), {0.05 * i, 0.0, {}});
  const auto places = seen.unknown({1.0, 0.0, {}}, kDisc, kMargin, time_from_seconds(2.0));
  EXPECT_FALSE(has_within(places, {-0.35, 0.0}, 0.1));
  EXPECT_TRUE(has_within(places, {-1.5, 0.0}, 0.3)) << "behind where it began";
}

TEST(SeenPlaces, NobodyCreepsIntoTheUnknown) {
  SeenPlaces seen;
  for (int i = 0; i <= 20; ++i) {  // it looks astern and creeps ahead
    const Pose2 odom_from_base{0.002 * i, 0.0, {}};
    seen.add(0, sweep(0.1 * i, 180.0, 5.0F, {0.0, 0.0, Angle::degrees(180.0)}), odom_from_base);
    const auto places = seen.unknown(odom_from_base, kDisc, kMargin, time_from_seconds(0.1 * i));
    for (const double away : {0.34, 0.37, 0.41})
      EXPECT_TRUE(has_within(places, {away - odom_from_base.x, 0.0}, 0.036)) << "where it was, nearer than before";
  }
}

}  // namespace
}  // namespace docent::collision_avoidance::seen_places_test
