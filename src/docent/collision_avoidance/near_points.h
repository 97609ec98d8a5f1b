#pragma once

#include <array>
#include <span>
#include <vector>

#include "docent/geometry/pose2.h"

namespace docent {

/// Tells whether anything of a set of points lies near a place: the points in square buckets as wide as "near", round a
/// middle. O(points) to make; a question looks at nine buckets.
class NearPoints {
 public:
  /// @param points  those farther than kHalf buckets from the middle along x or y are left out
  /// @param near  [m] > 0
  NearPoints(std::span<const Point2> points, Point2 middle, double near);

  [[nodiscard]] bool is_near(Point2 place) const;

 private:
  static constexpr int kHalf = 12;
  static constexpr int kSide = 2 * kHalf;
  /// Of the bucket along one axis; may lie outside.
  [[nodiscard]] int index_of(double offset) const;

  Point2 middle_;
  double near_;
  std::array<std::vector<Point2>, static_cast<std::size_t>(kSide) * kSide> buckets_;
};

}  // namespace docent
