#pragma once

#include <optional>
#include <vector>

#include "docent/geometry/pose2.h"

namespace docent {

/// The straight line between two points.
struct Segment {
  Point2 a;  ///< one end
  Point2 b;  ///< the other
};

/// A simple polygon, its corners in order; the last joins the first.
using Polygon = std::vector<Point2>;

[[nodiscard]] Point2 nearest_point(const Segment& segment, Point2 point);  ///< of the segment
[[nodiscard]] double distance(const Segment& segment, Point2 point);       ///< [m]

/// Distance along the unit vector `direction` from `origin` to the segment; nullopt when the ray misses it.
[[nodiscard]] std::optional<double> ray_distance(Point2 origin, Point2 direction, const Segment& segment);
/// Likewise to a circle's outline; 0 when the origin lies inside.
[[nodiscard]] std::optional<double> ray_distance(Point2 origin, Point2 direction, Point2 centre, double radius);

[[nodiscard]] bool contains(const Polygon& polygon, Point2 point);  ///< a point on the border: either
/// Distance to the polygon as a filled shape: 0 inside.
[[nodiscard]] double distance(const Polygon& polygon, Point2 point);
/// Distance to the polygon's outline, inside and outside.
[[nodiscard]] double outline_distance(const Polygon& polygon, Point2 point);
[[nodiscard]] double signed_area(const Polygon& polygon);                    ///< [m2], positive when counter-clockwise
[[nodiscard]] bool intersects(const Segment& first, const Segment& second);  ///< they have a point in common
/// True when no two sides of the outline cross. O(corners^2).
[[nodiscard]] bool is_simple(const Polygon& polygon);
[[nodiscard]] std::vector<Segment> sides(const Polygon& polygon);  ///< in the order of the corners

}  // namespace docent
