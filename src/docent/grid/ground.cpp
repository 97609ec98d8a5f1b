#include "docent/grid/ground.h"

#include <algorithm>
#include <limits>

namespace docent {

double room_on_ground(const Polygon& area, std::span<const Polygon> hazards, Point2 centre, double robot_radius,
                      const Clearance& clearance) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (!area.empty() && !contains(area, centre)) return -kInfinity;
  double room = area.empty() ? kInfinity : outline_distance(area, centre) - clearance.border;
  for (const Polygon& hazard : hazards)
    room = std::min(room, distance(hazard, centre) - robot_radius - clearance.hazards);
  return room;
}

}  // namespace docent
