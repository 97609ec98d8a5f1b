#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "docent/geometry/pose2.h"
#include "docent/sensor_models/range_sweep.h"

/// A room for the tests of this folder.
namespace docent::planning::testing {

/// [lasers] of a robot that sees all round it: ahead, and behind.
inline std::vector<Pose2> two_lasers() { return {Pose2{}, Pose2{0.0, 0.0, Angle::degrees(180.0)}}; }

/// The ranges [m] of such a laser at `map_from_laser` in a shut room of `length` x 4 m from the origin, in steps of a
/// degree.
inline std::vector<float> ranges_in_room(const Pose2& map_from_laser, double length = 6.0) {
  std::vector<float> ranges;
  for (int i = -90; i <= 90; ++i) {
    const Point2 along = unit(map_from_laser.theta + Angle::degrees(i));
    const Point2 from = map_from_laser.position();
    const double to_x = std::abs(along.x) < 1e-9 ? 99.0 : ((along.x > 0 ? length + 0.02 : 0.02) - from.x) / along.x;
    const double to_y = std::abs(along.y) < 1e-9 ? 99.0 : ((along.y > 0 ? 4.02 : 0.02) - from.y) / along.y;
    ranges.push_back(static_cast<float>(std::min(to_x, to_y)));
  }
  return ranges;
}
inline sensor_models::LaserReading reading_of(const std::vector<float>& ranges) {
  return {ranges, Angle::degrees(-90.0), Angle::degrees(1.0).radians(), 0.02, 10.0};
}

}  // namespace docent::planning::testing
