#include "docent/collision_avoidance/obstacle_field/straight_pieces.h"

#include <algorithm>
#include <cmath>

namespace docent {

namespace {

constexpr double kOff = 0.07;          // [m] from the line: noise and half a brick
constexpr double kLeastLength = 0.75;  // [m] wider than a person
constexpr std::size_t kLeastPoints = 5;

void fit(std::span<const Point2> points, std::size_t first, std::size_t last, std::vector<bool>& straight) {
  const Point2 way = points[last] - points[first];
  const double length = norm(way);
  if (last - first + 1 < kLeastPoints || length < 1e-6) return;
  std::size_t farthest = first;
  double most = 0.0;
  for (std::size_t i = first + 1; i < last; ++i) {
    const double off = std::abs(cross(way, points[i] - points[first])) / length;
    if (off <= most) continue;
    most = off;
    farthest = i;
  }
  if (most > kOff) {
    fit(points, first, farthest, straight);
    fit(points, farthest, last, straight);
    return;
  }
  if (length < kLeastLength) return;
  for (std::size_t i = first; i <= last; ++i) straight[i] = true;
}

}  // namespace

std::vector<bool> on_straight_pieces(std::span<const Point2> points, std::span<const double> ranges,
                                     double bearing_step) {
  std::vector<bool> straight(points.size(), false);
  std::size_t first = 0;
  for (std::size_t i = 1; i <= points.size(); ++i) {
    if (i < points.size()) {
      const double spacing = 0.15 + 2.5 * bearing_step * std::min(ranges[i], ranges[i - 1]);
      if (distance(points[i], points[i - 1]) < spacing) continue;
    }
    fit(points, first, i - 1, straight);
    first = i;
  }
  return straight;
}

}  // namespace docent
