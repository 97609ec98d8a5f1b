#pragma once

#include <span>

#include "docent/geometry/polygon.h"
#include "docent/grid/clearance.h"

namespace docent {

/// Room to spare [m] for the robot's centre by what no sensor sees: the area's border, which binds the centre, and
/// hazards, which bind the body. >= 0: it may be there; -infinity outside the area. An empty area is everywhere. The
/// one meaning of both for all who plan; avoidance measures the same from the whole belief (`Clearance`).
/// O(corners).
[[nodiscard]] double room_on_ground(const Polygon& area, std::span<const Polygon> hazards, Point2 centre,
                                    double robot_radius, const Clearance& clearance);

}  // namespace docent
