#include "docent/collision_avoidance/avoider/felt_places.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace docent::collision_avoidance {

void FeltPlaces::believe(const Pose2& map_from_odom, double mass) {
  if (mass < params_.sure) return;
  if (!map_from_odom_) things_.carry(map_from_odom);
  map_from_odom_ = map_from_odom;
}

void FeltPlaces::feel(Point2 at, Point2 outward, bool may_be_somebody, Time now) {
  if (!params_.remembers) return;
  const Pose2 here = map_from_odom_.value_or(Pose2{});
  things_.feel(here * at, here * outward - here.position(), may_be_somebody, now);
}

void FeltPlaces::stand(Point2 centre, double radius, Time now) {
  things_.forget(now);
  things_.stand(map_from_odom_.value_or(Pose2{}) * centre, radius);
}

std::vector<Point2> FeltPlaces::outlines(const Pose2& odom_from_base, double reach) const {
  std::vector<Point2> points;
  if (things_.discs().empty()) return points;
  const Pose2 base_from_here = inverse(map_from_odom_.value_or(Pose2{}) * odom_from_base);
  for (const FeltThings::Disc& disc : things_.discs()) {
    const Point2 middle = base_from_here * disc.middle();
    if (norm(middle) > reach + disc.radius) continue;
    const int steps = 1 + static_cast<int>(2.0 * std::numbers::pi * disc.radius / params_.point_step);
    for (int i = 0; i < steps; ++i)
      points.push_back(middle + disc.radius * unit(Angle::radians(2.0 * std::numbers::pi * i / steps)));
  }
  return points;
}

double FeltPlaces::gap(const Pose2& odom_from_base, const BaseLimits& limits) const {
  double least = std::numeric_limits<double>::infinity();
  if (things_.discs().empty()) return least;
  const Pose2 base_from_here = inverse(map_from_odom_.value_or(Pose2{}) * odom_from_base);
  for (const FeltThings::Disc& disc : things_.discs())
    least = std::min(least, limits.gap_to(base_from_here * disc.middle()) - disc.radius);
  return least;
}

}  // namespace docent::collision_avoidance
