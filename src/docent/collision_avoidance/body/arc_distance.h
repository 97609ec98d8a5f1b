#pragma once

#include "docent/geometry/pose2.h"

namespace docent::collision_avoidance {

/// A disc about the robot's centre must not come nearer than `reach` to `at`.
struct ReachPoint {
  Point2 at;           ///< [m], robot frame
  double reach = 0.0;  ///< [m]
};

/// Length of the way [m] along the circle of the given curvature, from the origin with heading +x, until the robot's
/// centre is `reach` away from the point. Closed form. Driving backwards: mirror the point in x and the curvature.
///
/// A point that is within reach already gives 0 when the first step brings the robot nearer, else infinity (driving
/// away from what is too near is how a robot gets free). Infinity also when the circle never meets the point.
/// @param curvature  [1/m], positive to the left
[[nodiscard]] double arc_distance(double curvature, const ReachPoint& point);

}  // namespace docent::collision_avoidance
