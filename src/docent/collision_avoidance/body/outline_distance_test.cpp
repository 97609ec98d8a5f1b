#include "docent/collision_avoidance/body/outline_distance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "docent/base/random.h"

namespace docent::collision_avoidance::outline_distance_test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Outline box(double front, double rear, double half_width) {
  return Outline::make({{front, half_width}, {-rear, half_width}, {-rear, -half_width}, {front, -half_width}}).value();
}

Pose2 place_on_arc(double curvature, double way) {
  if (std::abs(curvature) < 1e-9) return {way, 0.0, {}};
  const double angle = curvature * way;
  return {std::sin(angle) / curvature, (1.0 - std::cos(angle)) / curvature, Angle::radians(angle)};
}

TEST(Outline, KnownByHand) {
  const Outline body = box(0.5, 0.3, 0.2);
  EXPECT_DOUBLE_EQ(body.arc_distance(0.0, {2.0, 0.1}, 0.0), 1.5);
  EXPECT_NEAR(body.arc_distance(0.0, {2.0, 0.1}, 0.1), 1.4, 1e-12);
  EXPECT_EQ(body.arc_distance(0.0, {2.0, 0.31}, 0.1), kInfinity);
  EXPECT_NEAR(body.arc_distance(0.0, {2.0, 0.3}, 0.1), 1.5, 1e-6);  // a graze
  // The corner's circle: 0.06 beside the corner, 0.08 before it.
  EXPECT_NEAR(body.arc_distance(0.0, {2.0, 0.26}, 0.1), 1.5 - 0.08, 1e-12);
  EXPECT_EQ(body.arc_distance(0.0, {-2.0, 0.0}, 0.1), kInfinity);
  EXPECT_NEAR(body.circumradius(), std::hypot(0.5, 0.2), 1e-12);
}

TEST(Outline, OfABodyIsWhatItsConfigurationSays) {
  using Corners = std::vector<std::vector<double>>;
  EXPECT_TRUE(Outline::of_body(Corners{}).value().empty()) << "a disc";
  const auto body = Outline::of_body(Corners{{0.4, 0.2}, {-0.4, 0.2}, {-0.4, -0.2}, {0.4, -0.2}});
  ASSERT_TRUE(body);
  EXPECT_NEAR(body->radius_at({}), 0.4, 1e-12);
  EXPECT_FALSE(Outline::of_body(Corners{{0.4, 0.2, 0.0}, {-0.4, 0.2}, {0.0, -0.2}})) << "a corner of three numbers";
  EXPECT_FALSE(Outline::of_body(Corners{{0.4, 0.2}, {-0.4, 0.2}})) << "two corners";
}

TEST(Outline, ReachesAsFarAsItsSides) {
  const Outline body = box(0.5, 0.3, 0.2);
  EXPECT_NEAR(body.radius_at({}), 0.5, 1e-12);
  EXPECT_NEAR(body.radius_at(Angle::degrees(90)), 0.2, 1e-12);
  EXPECT_NEAR(body.radius_at(Angle::degrees(180)), 0.3, 1e-12);
  for (int degree = -180; degree < 180; ++degree) {
    const Angle bearing = Angle::degrees(degree);
    EXPECT_NEAR(outline_distance(body.corners(), body.radius_at(bearing) * unit(bearing)), 0.0, 1e-9);
  }
  EXPECT_NEAR(body.radius_at(Angle::radians(std::atan2(0.2, 0.5))), body.circumradius(), 1e-9);
}

TEST(Outline, ATurningBodyComesNearerToWhatStandsBesideIt) {
  const Outline body = box(0.5, 0.3, 0.2);
  EXPECT_NEAR(body.closing_speed(0.7, 0.0, {0.6, 0.0}), 0.7, 1e-12);
  EXPECT_NEAR(body.closing_speed(0.7, 0.0, {-0.6, 0.0}), -0.7, 1e-12);
  EXPECT_NEAR(body.closing_speed(0.7, 0.0, {0.0, 0.3}), 0.0, 1e-12);
  EXPECT_NEAR(body.closing_speed(0.0, 1.0, {0.4, 0.3}), 0.4, 1e-12);
  EXPECT_NEAR(body.closing_speed(0.0, 1.0, {-0.2, 0.3}), -0.2, 1e-12);
  EXPECT_NEAR(body.closing_speed(0.7, 0.0, {0.45, 0.0}), 0.7, 1e-12) << "inside, past the nearest side";
}

TEST(Outline, WithinTheMarginOnlyDrivingNearerIsBlocked) {
  const Outline body = box(0.5, 0.3, 0.2);
  EXPECT_EQ(body.arc_distance(0.0, {0.55, 0.0}, 0.1), 0.0);
  EXPECT_EQ(body.arc_distance(0.0, {-0.35, 0.0}, 0.1), kInfinity);
  EXPECT_EQ(body.arc_distance(2.0, {0.45, 0.25}, 0.1), 0.0);
  EXPECT_EQ(body.arc_distance(-2.0, {0.45, 0.25}, 0.1), kInfinity);
}

/// Against dense sampling of the motion: the slow twin is the first of many small steps that is too near.
TEST(Outline, AgreesWithDenseSampling) {
  Rng rng{31};
  int met = 0;
  for (int round = 0; round < 1500; ++round) {
    Polygon corners;
    const auto count = rng.integer(3, 8);
    for (std::int64_t i = 0; i < count; ++i) {
      const double bearing =
          (static_cast<double>(i) + rng.uniform(0.1, 0.9)) * 2.0 * std::numbers::pi / static_cast<double>(count);
      corners.push_back({rng.uniform(0.4, 0.6) * std::cos(bearing), rng.uniform(0.3, 0.4) * std::sin(bearing)});
    }
    const auto body = Outline::make(corners);
    if (!body) continue;  // not convex
    const double curvature = round % 5 == 0 ? 0.0 : rng.uniform(-1.0, 1.0) * rng.uniform(0.0, 5.0);
    const Point2 point{rng.uniform(-1.5, 1.5), rng.uniform(-1.5, 1.5)};
    const double margin = round % 4 == 0 ? 0.0 : rng.uniform(0.02, 0.3);
    if (body->distance_to(point) <= margin + 1e-3) continue;
    const double horizon =
        std::abs(curvature) > 1e-9 ? std::min(6.0, 2.0 * std::numbers::pi / std::abs(curvature)) : 6.0;
    const auto gap = [&](double way) {
      return body->distance_to(inverse(place_on_arc(curvature, way)) * point) - margin;
    };
    constexpr double kStep = 2e-3;
    double sampled = kInfinity;
    double least_gap = kInfinity;
    for (double way = 0.0; way < horizon; way += kStep) {
      least_gap = std::min(least_gap, gap(way));
      if (gap(way) <= 0.0) {
        sampled = way;
        break;
      }
    }
    const double exact = body->arc_distance(curvature, point, margin);
    if (sampled == kInfinity) {
      EXPECT_TRUE(exact >= horizon || least_gap < 5e-3) << "no graze in round " << round;
      continue;
    }
    ++met;
    EXPECT_LE(exact, sampled + 1e-9) << "round " << round;
    // Where it says that they touch, they do; between two samples a graze may have come first.
    EXPECT_NEAR(gap(exact), 0.0, 1e-7) << "round " << round;
  }
  EXPECT_GT(met, 200);
}

TEST(Outline, IsConvexAndHoldsTheCentre) {
  EXPECT_FALSE(Outline::make({{1, 0}, {0, 1}}));
  EXPECT_FALSE(Outline::make({{1, 1}, {2, 1}, {2, 2}, {1, 2}}));
  EXPECT_FALSE(Outline::make({{1, 0}, {0.1, 0.1}, {0, 1}, {-1, -1}}));
  const auto clockwise = Outline::make({{0.3, -0.2}, {-0.3, -0.2}, {-0.3, 0.2}, {0.3, 0.2}});
  ASSERT_TRUE(clockwise);
  EXPECT_NEAR(clockwise->arc_distance(0.0, {1.0, 0.0}, 0.1), 0.6, 1e-12);
}

}  // namespace
}  // namespace docent::collision_avoidance::outline_distance_test
