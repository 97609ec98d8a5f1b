#include "docent/mapping/scan_matching/point_sweep.h"

#include <gtest/gtest.h>

namespace docent::mapping {
namespace {

/// Beams of one degree onto a wall 2 m ahead; those to the left of `gap` degrees go 3 m farther.
sensor_models::RangeSweep wall_ahead(double gap) {
  sensor_models::RangeSweep sweep;
  for (int i = -40; i <= 40; ++i) {
    const double bearing = Angle::degrees(i).radians();
    const double ahead = i > gap ? 5.0 : 2.0;
    sweep.beams.push_back({bearing, ahead / std::cos(bearing), false});
  }
  return sweep;
}

TEST(SurfacePoints, LieOnTheWallAndPointTowardsTheSensor) {
  const auto points = surface_points(wall_ahead(90), {});
  ASSERT_EQ(points.size(), 81U);
  for (const SurfacePoint& point : points) {
    EXPECT_NEAR(point.at.x, 2.0, 1e-9);
    ASSERT_TRUE(point.has_normal());
    EXPECT_NEAR(point.normal.x, -1.0, 1e-6);
  }
}

TEST(SurfacePoints, ANormalIsNotFittedAcrossAGap) {
  for (const SurfacePoint& point : surface_points(wall_ahead(0), {})) {
    if (!point.has_normal()) continue;
    EXPECT_NEAR(point.normal.x, -1.0, 1e-6) << point.at.x << " " << point.at.y;
  }
}

TEST(SurfacePoints, WhatDidNotComeBackOrIsTheBodyIsLeftOut) {
  sensor_models::RangeSweep sweep;
  sweep.beams = {{0.0, 10.0, true}, {0.1, 0.01, false}, {0.2, 90.0, false}, {0.3, 3.0, false}};
  const auto points = surface_points(sweep, {});
  ASSERT_EQ(points.size(), 1U);
  EXPECT_FALSE(points[0].has_normal());
  EXPECT_NEAR(norm(points[0].at), 3.0, 1e-9);
}

TEST(SurfacePoints, TurnWithTheFrame) {
  const SurfacePoint turned = transformed({1.0, 2.0, Angle::degrees(90)}, {{3.0, 0.0}, {-1.0, 0.0}});
  EXPECT_NEAR(turned.at.x, 1.0, 1e-9);
  EXPECT_NEAR(turned.at.y, 5.0, 1e-9);
  EXPECT_NEAR(turned.normal.y, -1.0, 1e-9);
}

TEST(ThinnedPoints, KeepOneACell) {
  const std::vector<Point2> points{{0.01, 0.01}, {0.09, 0.09}, {0.11, 0.01}, {-0.01, 0.01}, {0.02, 0.03}};
  EXPECT_EQ(thinned_points(points, 0.1).size(), 3U);
}

}  // namespace
}  // namespace docent::mapping
