#include "docent/collision_avoidance/obstacle_field/range_flow.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "docent/base/random.h"
#include "docent/geometry/polygon.h"

namespace docent::collision_avoidance::range_flow_test {
namespace {

constexpr double kBeam = std::numbers::pi / 180.0;
constexpr double kRadius = 0.22;  // [m] of people

struct World {
  std::vector<Point2> people;
  std::vector<Segment> walls;
};

/// Five sweeps a tenth of a second apart of a sensor that drives along x with `speed`; `world_at` says what it sees.
template <class WorldAt>
std::vector<std::pair<Point2, Point2>> flow_of(double speed, double noise, const WorldAt& world_at) {
  RangeFlow flow;
  Rng rng{3};
  std::vector<Point2> places;
  for (int k = 0; k < 5; ++k) {
    const double time = 0.1 * k;
    const World world = world_at(time);
    const Pose2 odom_from_sensor{speed * time, 0.0, {}};
    std::vector<float> ranges;
    std::vector<int> beams;
    places.clear();
    for (int i = 0; i < 181; ++i) {
      const Angle bearing = Angle::radians(-0.5 * std::numbers::pi + i * kBeam);
      double range = 10.0;
      for (const auto& wall : world.walls)
        if (const auto hit = ray_distance(odom_from_sensor.position(), unit(bearing), wall))
          range = std::min(range, *hit);
      for (const auto person : world.people)
        if (const auto hit = ray_distance(odom_from_sensor.position(), unit(bearing), person, kRadius))
          range = std::min(range, *hit);
      if (range < 10.0) {
        range += rng.normal(0.0, noise);
        beams.push_back(i);
        places.push_back(odom_from_sensor * (range * unit(bearing)));
      }
      ranges.push_back(static_cast<float>(range));
    }
    flow.add(time_from_seconds(1.0 + time), odom_from_sensor, -0.5 * std::numbers::pi, kBeam, ranges, places, beams);
  }
  const auto velocities = flow.velocities();
  std::vector<std::pair<Point2, Point2>> result;
  for (std::size_t i = 0; i < velocities.size(); ++i) result.emplace_back(places[i], velocities[i]);
  return result;
}

TEST(RangeFlow, WhatStandsDoesNotComeNearerWhileTheSensorDrives) {
  const auto flow = flow_of(0.7, 0.02, [](double) {
    return World{{{1.2, 0.5}, {1.5, 0.1}, {1.0, -0.7}}, {{{3.0, -3.0}, {3.0, 3.0}}, {{0.5, 0.9}, {3.0, 0.9}}}};
  });
  int false_ones = 0;
  for (const auto& [place, velocity] : flow) false_ones += velocity == Point2{} ? 0 : 1;
  EXPECT_EQ(false_ones, 0);
  EXPECT_GT(flow.size(), 100U);
}

TEST(RangeFlow, WhoComesOutOfAThrongIsKnownByHowMuchNearerTheyAre) {
  // Shoulder to shoulder in a row; the middle one comes with 1 m/s.
  const auto flow = flow_of(0.3, 0.02, [](double time) {
    return World{{{1.8, -0.9}, {1.8, -0.45}, {1.8 - time, 0.0}, {1.8, 0.45}, {1.8, 0.9}}, {}};
  });
  int coming = 0;
  for (const auto& [place, velocity] : flow) {
    if (std::abs(place.y) < 0.12) {
      EXPECT_NEAR(velocity.x, -1.0, 0.25) << place.y;
      ++coming;
    } else if (std::abs(place.y) > 0.3) {
      EXPECT_EQ(velocity, Point2{}) << place.y;
    }
  }
  EXPECT_GT(coming, 5);
}

TEST(RangeFlow, WhoGoesAwayOrStandsWhereNobodyCouldLookIsNotComing) {
  const auto away = flow_of(0.0, 0.02, [](double time) { return World{{{1.2 + time, 0.0}}, {}}; });
  for (const auto& [place, velocity] : away) EXPECT_EQ(velocity, Point2{});
  // The one in front steps aside: who stood behind them all the while is seen now.
  const auto bared = flow_of(0.0, 0.02, [](double time) { return World{{{1.0, 1.5 * time}, {2.0, 0.0}}, {}}; });
  for (const auto& [place, velocity] : bared) {
    if (place.x < 1.5) continue;
    EXPECT_EQ(velocity, Point2{});
  }
}

}  // namespace
}  // namespace docent::collision_avoidance::range_flow_test
