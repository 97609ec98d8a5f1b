#include "docent/geometry/polygon.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace docent {

Point2 nearest_point(const Segment& segment, Point2 point) {
  const Point2 along = segment.b - segment.a;
  const double length_squared = dot(along, along);
  if (length_squared <= 0.0) return segment.a;
  const double t = std::clamp(dot(point - segment.a, along) / length_squared, 0.0, 1.0);
  return segment.a + t * along;
}

double distance(const Segment& segment, Point2 point) { return distance(nearest_point(segment, point), point); }

std::optional<double> ray_distance(Point2 origin, Point2 direction, const Segment& segment) {
  const Point2 along = segment.b - segment.a;
  const double denominator = cross(direction, along);
  if (denominator == 0.0) return std::nullopt;
  const Point2 offset = segment.a - origin;
  const double t = cross(offset, along) / denominator;
  const double u = cross(offset, direction) / denominator;
  if (t < 0.0 || u < 0.0 || u > 1.0) return std::nullopt;
  return t;
}

std::optional<double> ray_distance(Point2 origin, Point2 direction, Point2 centre, double radius) {
  const Point2 offset = centre - origin;
  const double off_squared = dot(offset, offset);
  if (off_squared <= radius * radius) return 0.0;
  const double along = dot(offset, direction);
  if (along < 0.0) return std::nullopt;
  const double side_squared = off_squared - along * along;
  if (side_squared > radius * radius) return std::nullopt;
  return along - std::sqrt(radius * radius - side_squared);
}

bool contains(const Polygon& polygon, Point2 point) {
  bool inside = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Point2 a = polygon[i];
    const Point2 b = polygon[j];
    if ((a.y > point.y) != (b.y > point.y) && point.x < (b.x - a.x) * (point.y - a.y) / (b.y - a.y) + a.x) {
      inside = !inside;
    }
  }
  return inside;
}

double outline_distance(const Polygon& polygon, Point2 point) {
  double least_square = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Point2 off = nearest_point(Segment{polygon[j], polygon[i]}, point) - point;
    least_square = std::min(least_square, dot(off, off));
  }
  return std::sqrt(least_square);
}

double distance(const Polygon& polygon, Point2 point) {
  return contains(polygon, point) ? 0.0 : outline_distance(polygon, point);
}

double signed_area(const Polygon& polygon) {
  double twice = 0.0;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) twice += cross(polygon[j], polygon[i]);
  return 0.5 * twice;
}

bool intersects(const Segment& first, const Segment& second) {
  const auto side = [](const Segment& s, Point2 p) { return cross(s.b - s.a, p - s.a); };
  const double d1 = side(second, first.a);
  const double d2 = side(second, first.b);
  const double d3 = side(first, second.a);
  const double d4 = side(first, second.b);
  if (((d1 > 0) != (d2 > 0)) && ((d3 > 0) != (d4 > 0)) && d1 != 0 && d2 != 0 && d3 != 0 && d4 != 0) return true;
  const auto touches = [](const Segment& s, Point2 p, double d) { return d == 0 && distance(s, p) == 0.0; };
  return touches(second, first.a, d1) || touches(second, first.b, d2) || touches(first, second.a, d3) ||
         touches(first, second.b, d4);
}

bool is_simple(const Polygon& polygon) {
  const auto all = sides(polygon);
  const std::size_t count = all.size();
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = i + 2; j < count; ++j) {
      if (i == 0 && j == count - 1) continue;  // neighbours share a corner
      if (intersects(all[i], all[j])) return false;
    }
  }
  return true;
}

std::vector<Segment> sides(const Polygon& polygon) {
  std::vector<Segment> result;
  result.reserve(polygon.size());
  for (std::size_t i = 0; i < polygon.size(); ++i) result.push_back({polygon[i], polygon[(i + 1) % polygon.size()]});
  return result;
}

}  // namespace docent
