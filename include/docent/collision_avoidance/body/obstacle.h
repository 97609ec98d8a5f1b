#pragma once

#include <span>

#include "docent/collision_avoidance/body/base_motion.h"
#include "docent/geometry/pose2.h"

namespace docent::collision_avoidance {

/// A thing not to touch, in the frame of the base at the moment from which motion is planned.
struct Obstacle {
  Point2 at;                ///< [m]
  Point2 velocity{};        ///< [m/s]
  double margin = 0.0;      ///< [m] between its point and the robot's outline; of the border: its centre
  bool person = false;      ///< slim and free-standing
  bool is_virtual = false;  ///< a hazard or the border, measured from the belief
  bool is_border = false;   ///< of the area: the robot's body may reach over it, its centre may not
  bool is_unknown = false;  ///< nothing has seen what is there
  bool is_low = false;      ///< met below the lasers, which see nobody there: a thing
  bool may_step = false;  ///< may be somebody, also half hidden in a throng, who steps nearer; the window does not ask
  double perhaps = 0.0;   ///< [m] beyond the margin, where more of somebody may be: passed no faster than harmless
};

/// Distance [m] from the robot's centre to an obstacle at which a disc of this radius just keeps its margin.
[[nodiscard]] inline double reach_of(const Obstacle& obstacle, double body_radius) {
  return obstacle.is_border ? obstacle.margin : body_radius + obstacle.margin;
}
/// How much farther away [m] an obstacle is than its margin asks.
[[nodiscard]] inline double slack_to(const Obstacle& obstacle, const BaseLimits& limits) {
  return (obstacle.is_border ? norm(obstacle.at) : limits.gap_to(obstacle.at)) - obstacle.margin;
}

/// Free way [m] of a disc of radius `reach` straight along `bearing`, at most `horizon`; points within reach block only
/// when they lie ahead.
[[nodiscard]] double straight_free_way(double bearing, std::span<const Obstacle> obstacles, double body_radius,
                                       double horizon);

}  // namespace docent::collision_avoidance
