#include "docent/collision_avoidance/obstacle_field/straight_pieces.h"

#include <algorithm>
#include <cmath>

namespace docent::collision_avoidance {

namespace {

void fit(std::span<const Point2> points, std::size_t first, std::size_t last, std::vector<bool>& straight,
         const StraightPiecesParams& params) {
  const Point2 way = points[last] - points[first];
  const double length = norm(way);
  if (last - first + 1 < params.least_points || length < 1e-6) return;
  std::size_t farthest = first;
  double most = 0.0;
  for (std::size_t i = first + 1; i < last; ++i) {
    const double off = std::abs(cross(way, points[i] - points[first])) / length;
    if (off <= most) continue;
    most = off;
    farthest = i;
  }
  if (most > params.off) {
    fit(points, first, farthest, straight, params);
    fit(points, farthest, last, straight, params);
    return;
  }
  if (length < params.least_length) return;
  for (std::size_t i = first; i <= last; ++i) straight[i] = true;
}

}  // namespace

std::vector<bool> on_straight_pieces(std::span<const Point2> points, std::span<const double> ranges,
                                     double bearing_step, const StraightPiecesParams& params) {
  std::vector<bool> straight(points.size(), false);
  std::size_t first = 0;
  for (std::size_t i = 1; i <= points.size(); ++i) {
    if (i < points.size()) {
      const double spacing = spacing_of(ranges[i], ranges[i - 1], bearing_step, params.piece);
      if (distance(points[i], points[i - 1]) < spacing) continue;
    }
    fit(points, first, i - 1, straight, params);
    first = i;
  }
  return straight;
}

}  // namespace docent::collision_avoidance
