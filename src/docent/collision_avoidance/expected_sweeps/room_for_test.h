#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "docent/base/random.h"
#include "docent/collision_avoidance/obstacle_field/obstacle_memory.h"
#include "docent/geometry/polygon.h"

namespace docent::collision_avoidance {

/// A room of walls and round things, as a scanner in order sees it. For tests.
struct RoomForTest {
  struct Disc {
    Point2 centre;
    double radius = 0.25;
  };
  std::vector<Segment> walls;
  std::vector<Disc> discs;
  double noise = 0.015;  ///< [m] standard deviation
  double min_range = 0.05;
  double max_range = 10.0;
  Rng rng{1};

  void box(double x0, double y0, double x1, double y1) {
    walls.push_back({{x0, y0}, {x1, y0}});
    walls.push_back({{x1, y0}, {x1, y1}});
    walls.push_back({{x1, y1}, {x0, y1}});
    walls.push_back({{x0, y1}, {x0, y0}});
  }

  /// 180 beams over 180 degrees, ahead.
  SensorSweep sweep(double time, const Pose2& odom_from_sensor) {
    constexpr double kBeam = std::numbers::pi / 180.0;
    SensorSweep sweep{
        time_from_seconds(time), {}, -0.5 * std::numbers::pi + 0.5 * kBeam, kBeam, min_range, max_range, {}};
    for (int i = 0; i < 180; ++i) {
      const Point2 ray = unit(odom_from_sensor.theta + Angle::radians(sweep.first_bearing + i * kBeam));
      double range = std::numeric_limits<double>::infinity();
      for (const Segment& wall : walls)
        if (const auto hit = ray_distance(odom_from_sensor.position(), ray, wall)) range = std::min(range, *hit);
      for (const Disc& disc : discs)
        if (const auto hit = ray_distance(odom_from_sensor.position(), ray, disc.centre, disc.radius))
          range = std::min(range, *hit);
      range =
          range < max_range ? std::max(0.01, range + rng.normal(0.0, noise)) : std::numeric_limits<double>::infinity();
      sweep.ranges.push_back(static_cast<float>(range));
    }
    return sweep;
  }
};

}  // namespace docent::collision_avoidance
