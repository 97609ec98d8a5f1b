#include "docent/collision_avoidance/body/arc_distance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "docent/base/random.h"

namespace docent::collision_avoidance::arc_distance_test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Point2 place_on_arc(double curvature, double way) {
  if (std::abs(curvature) < 1e-9) return {way, 0.0};
  return {std::sin(curvature * way) / curvature, (1.0 - std::cos(curvature * way)) / curvature};
}

/// The slow twin: the first of many small steps that is too near.
double sampled_distance(double curvature, const ReachPoint& point, double horizon) {
  constexpr double kStep = 1e-3;
  for (double way = 0.0; way <= horizon; way += kStep) {
    if (distance(place_on_arc(curvature, way), point.at) < point.reach) return way;
  }
  return kInfinity;
}

TEST(ArcDistance, KnownByHand) {
  EXPECT_DOUBLE_EQ(arc_distance(0.0, {{2.0, 0.0}, 0.5}), 1.5);
  EXPECT_EQ(arc_distance(0.0, {{2.0, 0.5}, 0.5}), kInfinity);
  EXPECT_EQ(arc_distance(0.0, {{-2.0, 0.0}, 0.5}), kInfinity);
  // A quarter turn of radius 1 ends at (1, 1), less the reach along the arc.
  EXPECT_NEAR(arc_distance(1.0, {{1.0, 1.0}, 1e-6}), 0.5 * std::numbers::pi, 1e-5);
  EXPECT_NEAR(arc_distance(-1.0, {{1.0, -1.0}, 1e-6}), 0.5 * std::numbers::pi, 1e-5);
  // Behind, reached after most of the circle.
  EXPECT_NEAR(arc_distance(1.0, {{-1.0, 1.0}, 1e-6}), 1.5 * std::numbers::pi, 1e-5);
}

TEST(ArcDistance, WithinReachOnlyDrivingNearerIsBlocked) {
  EXPECT_EQ(arc_distance(0.0, {{0.2, 0.1}, 0.4}), 0.0);
  EXPECT_EQ(arc_distance(2.0, {{-0.2, 0.1}, 0.4}), kInfinity);
}

TEST(ArcDistance, AgreesWithDenseSampling) {
  Rng rng{11};
  int met = 0;
  for (int i = 0; i < 4000; ++i) {
    const double curvature = i % 7 == 0 ? 0.0 : rng.uniform(-1.0, 1.0) * rng.uniform(0.0, 6.0);
    const ReachPoint point{{rng.uniform(-1.5, 1.5), rng.uniform(-1.5, 1.5)}, rng.uniform(0.05, 0.6)};
    if (norm(point.at) <= point.reach) continue;
    const double circle = std::abs(curvature) > 1e-9 ? 2.0 * std::numbers::pi / std::abs(curvature) : 8.0;
    const double sampled = sampled_distance(curvature, point, std::min(circle, 8.0));
    const double exact = arc_distance(curvature, point);
    if (sampled == kInfinity) {
      // A graze between two samples is no disagreement.
      if (exact < std::min(circle, 8.0)) {
        EXPECT_GT(distance(place_on_arc(curvature, exact + 5e-4), point.at), point.reach - 1e-4)
            << curvature << " " << point.at.x << " " << point.at.y << " " << point.reach;
      }
      continue;
    }
    ++met;
    EXPECT_NEAR(exact, sampled, 0.03) << curvature << " " << point.at.x << " " << point.at.y << " " << point.reach;
    EXPECT_NEAR(distance(place_on_arc(curvature, exact), point.at), point.reach, 1e-6);
  }
  EXPECT_GT(met, 400);
}

}  // namespace
}  // namespace docent::collision_avoidance::arc_distance_test
