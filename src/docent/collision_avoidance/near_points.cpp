#include "docent/collision_avoidance/near_points.h"

#include <algorithm>
#include <cmath>

namespace docent {

NearPoints::NearPoints(std::span<const Point2> points, Point2 middle, double near) : middle_{middle}, near_{near} {
  for (const Point2 point : points) {
    const int column = index_of(point.x - middle.x);
    const int row = index_of(point.y - middle.y);
    if (column < 0 || column >= kSide || row < 0 || row >= kSide) continue;
    buckets_[static_cast<std::size_t>(row * kSide + column)].push_back(point);
  }
}

int NearPoints::index_of(double offset) const {
  const double index = std::floor(offset / near_) + kHalf;
  return static_cast<int>(std::clamp(index, -2.0, kSide + 1.0));
}

bool NearPoints::is_near(Point2 place) const {
  const int column = index_of(place.x - middle_.x);
  const int row = index_of(place.y - middle_.y);
  for (int y = std::max(0, row - 1); y <= std::min(kSide - 1, row + 1); ++y) {
    for (int x = std::max(0, column - 1); x <= std::min(kSide - 1, column + 1); ++x) {
      const auto& bucket = buckets_[static_cast<std::size_t>(y * kSide + x)];
      if (std::any_of(bucket.begin(), bucket.end(), [&](Point2 some) { return distance(some, place) < near_; }))
        return true;
    }
  }
  return false;
}

}  // namespace docent
