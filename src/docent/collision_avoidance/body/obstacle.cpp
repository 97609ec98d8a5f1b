#include "docent/collision_avoidance/body/obstacle.h"

#include <algorithm>

#include "docent/collision_avoidance/body/arc_distance.h"

namespace docent::collision_avoidance {

double straight_free_way(double bearing, std::span<const Obstacle> obstacles, double body_radius, double horizon) {
  const Point2 ahead = unit(Angle::radians(bearing));
  double least = horizon;
  for (const auto& obstacle : obstacles) {
    const ReachPoint turned{{dot(ahead, obstacle.at), cross(ahead, obstacle.at)}, reach_of(obstacle, body_radius)};
    if (turned.at.x > least + turned.reach || turned.at.x < -turned.reach) continue;
    least = std::min(least, arc_distance(0.0, turned));
  }
  return least;
}

}  // namespace docent::collision_avoidance
