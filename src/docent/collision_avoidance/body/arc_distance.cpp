#include "docent/collision_avoidance/body/arc_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace docent::collision_avoidance {

double arc_distance(double curvature, const ReachPoint& point) {
  constexpr double kMissed = std::numeric_limits<double>::infinity();
  const double x = point.at.x;
  const double y = point.at.y;
  const double reach = point.reach;
  if (x * x + y * y <= reach * reach) return x > 0.0 ? 0.0 : kMissed;
  if (std::abs(curvature) < 1e-4) {
    if (x <= 0.0 || std::abs(y) >= reach) return kMissed;
    return x - std::sqrt(reach * reach - y * y);
  }
  // A right turn is a left turn in the mirror. The circle's centre is (0, radius); the robot starts below it.
  const double radius = 1.0 / std::abs(curvature);
  const double side = curvature > 0.0 ? y : -y;
  const double to_centre = std::hypot(x, side - radius);
  if (to_centre >= radius + reach || to_centre <= std::abs(radius - reach)) return kMissed;
  const double bearing = std::atan2(x, radius - side);  // of the point, seen from the centre, from the start on
  const double cosine = (radius * radius + to_centre * to_centre - reach * reach) / (2.0 * radius * to_centre);
  double angle = bearing - std::acos(std::clamp(cosine, -1.0, 1.0));
  if (angle < 0.0) angle += 2.0 * std::numbers::pi;
  return radius * angle;
}

}  // namespace docent::collision_avoidance
