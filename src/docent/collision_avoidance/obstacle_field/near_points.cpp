#include "docent/collision_avoidance/obstacle_field/near_points.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace docent::collision_avoidance {

NearPoints::NearPoints(std::span<const Point2> points, Point2 middle, double near) : middle_{middle}, near_{near} {
  std::vector<std::size_t> buckets(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const int column = index_of(points[i].x - middle.x);
    const int row = index_of(points[i].y - middle.y);
    const bool is_inside = column >= 0 && column < kSide && row >= 0 && row < kSide;
    buckets[i] = is_inside ? bucket_at(column, row) : kBuckets;
    ++starts_[buckets[i] + 1];
  }
  std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
  auto next = starts_;
  points_.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) points_[next[buckets[i]]++] = points[i];
}

int NearPoints::index_of(double offset) const {
  const double index = std::floor(offset / near_) + kHalf;
  return static_cast<int>(std::clamp(index, -2.0, kSide + 1.0));
}

bool NearPoints::is_near(Point2 place) const {
  constexpr double kSurely = 1.0 + 1e-9;  // more than rounding may do
  const int column = index_of(place.x - middle_.x);
  const int row = index_of(place.y - middle_.y);
  const int left = std::max(0, column - 1);
  const int right = std::min(kSide - 1, column + 1);
  if (left > right) return false;
  for (int y = std::max(0, row - 1); y <= std::min(kSide - 1, row + 1); ++y) {
    for (std::size_t i = starts_[bucket_at(left, y)]; i < starts_[bucket_at(right, y) + 1]; ++i) {
      const Point2 off = points_[i] - place;
      if (dot(off, off) <= kSurely * near_ * near_ && norm(off) < near_) return true;
    }
  }
  return false;
}

}  // namespace docent::collision_avoidance
