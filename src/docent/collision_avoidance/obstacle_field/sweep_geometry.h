#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

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

/// [beams] Unit vectors to where beams look, sensor frame. O(beams).
[[nodiscard]] inline std::vector<Point2> beam_directions(double first_bearing, double bearing_step, std::size_t beams) {
  std::vector<Point2> units(beams);
  for (std::size_t i = 0; i < beams; ++i)
    units[i] = unit(Angle::radians(first_bearing + static_cast<double>(i) * bearing_step));
  return units;
}

/// Where the beams of a scanner look, sensor frame: computed once, as long as its sweeps keep their form.
class BeamDirections {
 public:
  /// [beams] Unit vectors. O(1) for a form that is known, else O(beams).
  [[nodiscard]] const std::vector<Point2>& of(double first_bearing, double bearing_step, std::size_t beams) {
    if (first_bearing == first_bearing_ && bearing_step == bearing_step_ && beams == units_.size()) return units_;
    first_bearing_ = first_bearing;
    bearing_step_ = bearing_step;
    units_ = beam_directions(first_bearing, bearing_step, beams);
    return units_;
  }

 private:
  double first_bearing_ = 0.0;  ///< [rad]
  double bearing_step_ = 0.0;   ///< [rad]
  std::vector<Point2> units_;
};

/// [rad] more than rough_bearing is off.
inline constexpr double kRoughBearing = 2e-5;

/// atan2 to within kRoughBearing, in a quarter of its time: Abramowitz and Stegun, Handbook, 4.4.47.
[[nodiscard]] inline double rough_bearing(Point2 point) {
  const double x = std::abs(point.x);
  const double y = std::abs(point.y);
  const double most = std::max(x, y);
  if (most == 0.0) return 0.0;
  const double z = std::min(x, y) / most;
  const double s = z * z;
  const double within =
      z * (0.9998660 + s * (-0.3302995 + s * (0.1801410 + s * (-0.0851330 + s * 0.0208351))));  // of an eighth
  const double quarter = y > x ? kRightAngle - within : within;
  const double half = point.x < 0.0 ? std::numbers::pi - quarter : quarter;
  return point.y < 0.0 ? -half : half;
}

/// Number of the beam that looks nearest to a place, sensor frame; negative or beyond the last: none does.
[[nodiscard]] inline long beam_to(Point2 in_sensor, double first_bearing, double bearing_step) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  const double before = -0.5 * bearing_step;
  // A rough bearing tells it, but half-way between two beams, and where the turn begins anew before the first one.
  double turn = rough_bearing(in_sensor) - first_bearing;
  if (turn < before) turn += kTurn;
  if (turn >= before && turn < kTurn + before - kRoughBearing) {
    const auto nearest = static_cast<long>((turn - before) / bearing_step);
    if (std::abs(turn - static_cast<double>(nearest) * bearing_step) < -before - kRoughBearing) return nearest;
  }
  turn = Angle::radians(std::atan2(in_sensor.y, in_sensor.x) - first_bearing).radians();
  return std::lround((turn < before ? turn + kTurn : turn) / bearing_step);
}

}  // namespace docent::collision_avoidance
