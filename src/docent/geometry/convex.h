#pragma once

#include "docent/geometry/polygon.h"

namespace docent {

/// True when all corners turn the same way, once round, none on a straight line. O(corners^2).
[[nodiscard]] bool is_convex(const Polygon& polygon);
/// True for a point inside that lies on no side.
[[nodiscard]] bool holds_inside(const Polygon& polygon, Point2 point);

}  // namespace docent
