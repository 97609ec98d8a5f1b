#include "docent/collision_avoidance/dynamic_window/free_ways.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "docent/base/random.h"

namespace docent::collision_avoidance {
namespace {

/// The slow twin: every arc against every point, in closed form.
double closed_form(double curvature, std::span<const ReachPoint> points, bool backwards = false) {
  double least = FreeWays::kHorizon;
  for (ReachPoint point : points) {
    if (backwards) point.at.x = -point.at.x;
    least = std::min(least, arc_distance(curvature, point));
  }
  return least;
}

std::vector<ReachPoint> any_points(Rng& rng, int count, double spread) {
  std::vector<ReachPoint> points;
  while (static_cast<int>(points.size()) < count) {
    const ReachPoint point{{rng.uniform(-spread, spread), rng.uniform(-spread, spread)}, rng.uniform(0.05, 0.6)};
    if (norm(point.at) > point.reach) points.push_back(point);
  }
  return points;
}

std::vector<double> any_curvatures(Rng& rng, std::size_t count) {
  std::vector<double> curvatures;
  while (curvatures.size() < count) {
    const double curvature = rng.uniform(-1.0, 1.0) * rng.uniform(0.0, 6.0);
    // The closed form takes what is nearly straight for straight.
    curvatures.push_back(curvatures.size() % 17 == 0 || std::abs(curvature) < 1e-4 ? 0.0 : curvature);
  }
  return curvatures;
}

/// Never longer than the true free way, nor shorter, by more than this [m]; beyond a graze, which both must call so.
constexpr double kEpsilon = 1e-7;

TEST(FreeWays, AreThoseOfTheClosedForm) {
  Rng rng{21};
  int met = 0;
  for (int round = 0; round < 300; ++round) {
    const auto points = any_points(rng, static_cast<int>(rng.integer(1, 60)), round % 2 == 0 ? 1.2 : 4.0);
    const auto curvatures = any_curvatures(rng, 200);
    const bool backwards = round % 3 == 0;
    FreeWays fast;
    fast.build(points, backwards);
    std::vector<double> ways(curvatures.size());
    fast.along(curvatures, ways);
    for (std::size_t i = 0; i < curvatures.size(); ++i) {
      const double exact = closed_form(curvatures[i], points, backwards);
      ASSERT_NEAR(ways[i], exact, kEpsilon) << "round " << round << ", curvature " << curvatures[i];
      met += exact < FreeWays::kHorizon ? 1 : 0;
    }
  }
  EXPECT_GT(met, 20000);
}

TEST(FreeWays, AreTheSameBitsInEveryInstructionSet) {
  Rng rng{22};
  for (int round = 0; round < 50; ++round) {
    const auto points = any_points(rng, 200, 3.5);
    const auto curvatures = any_curvatures(rng, 300);
    std::vector<std::vector<double>> ways;
    for (const InstructionSet set : instruction_sets()) {
      FreeWays fast{set};
      fast.build(points, false);
      fast.along(curvatures, ways.emplace_back(curvatures.size()));
      EXPECT_EQ(ways.back(), ways.front()) << name_of(set);
    }
  }
}

TEST(FreeWays, KnownByHand) {
  FreeWays fast;
  const std::vector<ReachPoint> points{{{1.0, 1.0}, 1e-6}, {{2.0, 0.0}, 0.5}, {{-1.0, 1.0}, 1e-6}};
  const std::vector<double> curvatures{0.0, 1.0, -1.0, 100.0};
  std::vector<double> ways(curvatures.size());
  fast.build(points, false);
  fast.along(curvatures, ways);
  EXPECT_NEAR(ways[0], 1.5, 1e-12);
  EXPECT_NEAR(ways[1], 0.5 * std::numbers::pi, 1e-5);  // a quarter turn of radius 1
  EXPECT_EQ(ways[2], FreeWays::kHorizon);
  EXPECT_EQ(ways[3], FreeWays::kHorizon);
  fast.build({}, false);
  fast.along(curvatures, ways);
  for (const double way : ways) EXPECT_EQ(way, FreeWays::kHorizon);
}

TEST(FreeWays, FindWhatLiesBehindAfterMostOfTheCircle) {
  FreeWays fast;
  const ReachPoint behind{{-0.4, 0.4}, 1e-6};
  fast.build({&behind, 1}, false);
  const double curvature = 2.5;
  double way = 0.0;
  fast.along({&curvature, 1}, {&way, 1});
  EXPECT_NEAR(way, 1.5 * std::numbers::pi / 2.5, 1e-5);
}

TEST(FreeWays, WithinReachOnlyDrivingNearerIsBlocked) {
  FreeWays fast;
  const ReachPoint ahead{{0.2, 0.1}, 0.4};
  const double curvature = 0.5;
  double way = -1.0;
  fast.build({&ahead, 1}, false);
  fast.along({&curvature, 1}, {&way, 1});
  EXPECT_EQ(way, 0.0);
  fast.build({&ahead, 1}, true);
  fast.along({&curvature, 1}, {&way, 1});
  EXPECT_EQ(way, FreeWays::kHorizon);
}

TEST(FreeWays, WhatIsNoNumberLiesNowhereAndDisturbsNothing) {
  const double nan = std::nan("");
  const double infinity = std::numeric_limits<double>::infinity();
  FreeWays fast;
  const std::vector<ReachPoint> points{{{nan, 0.0}, 0.4}, {{1.0, nan}, 0.4},      {{1.0, 0.0}, nan},
                                       {{2.0, 0.0}, 0.4}, {{infinity, 0.0}, 0.4}, {{-infinity, nan}, 0.4}};
  const std::array curvatures{0.0, nan, infinity};
  std::array<double, 3> ways{};
  fast.build(points, false);
  fast.along(curvatures, ways);
  EXPECT_NEAR(ways[0], 1.6, 1e-9);
}

}  // namespace
}  // namespace docent::collision_avoidance
