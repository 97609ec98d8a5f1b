#include "docent/geometry/convex.h"

namespace docent {

bool is_convex(const Polygon& polygon) {
  if (polygon.size() < 3) return false;
  const double side = signed_area(polygon) > 0.0 ? 1.0 : -1.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point2 a = polygon[i];
    const Point2 b = polygon[(i + 1) % polygon.size()];
    const Point2 c = polygon[(i + 2) % polygon.size()];
    if (!(side * cross(b - a, c - b) > 0.0)) return false;
  }
  return is_simple(polygon);  // a star turns the same way everywhere, too
}

bool holds_inside(const Polygon& polygon, Point2 point) {
  return contains(polygon, point) && outline_distance(polygon, point) > 0.0;
}

}  // namespace docent
