#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "docent/geometry/pose2.h"

namespace docent::collision_avoidance {

/// How far apart neighbours of one sweep may be that belong to one thing.
struct PieceParams {
  double least_spacing = 0.15;  ///< [m] near the sensor, where noise and gaps in clothes count for most
  double per_beam = 2.5;        ///< distances between two beams side by side: a surface that is seen aslant
};

/// [m] between two neighbours, of these ranges [m], beyond which the second one begins another piece.
[[nodiscard]] inline double spacing_of(double range, double other, double bearing_step,
                                       const PieceParams& params = {}) {
  return params.least_spacing + params.per_beam * bearing_step * std::min(range, other);
}

/// Number of the beam that looks nearest to a place, sensor frame; negative or beyond the last: none does.
[[nodiscard]] inline long beam_to(Point2 in_sensor, double first_bearing, double bearing_step) {
  const double turn = Angle::radians(std::atan2(in_sensor.y, in_sensor.x) - first_bearing).radians();
  const double unwrapped = turn < -0.5 * bearing_step ? turn + 2.0 * std::numbers::pi : turn;
  return std::lround(unwrapped / bearing_step);
}

}  // namespace docent::collision_avoidance
