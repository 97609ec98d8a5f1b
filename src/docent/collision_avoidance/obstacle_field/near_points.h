#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "docent/geometry/pose2.h"

namespace docent::collision_avoidance {

/// Tells whether anything of a set of points lies near a place: the points in square buckets as wide as "near", round a
/// middle. O(points) to make; a question looks at nine buckets, three by three side by side.
class NearPoints {
 public:
  /// @param points  those farther than kHalf buckets from the middle along x or y are left out
  /// @param near  [m] > 0
  NearPoints(std::span<const Point2> points, Point2 middle, double near);

  [[nodiscard]] bool is_near(Point2 place) const;

 private:
  static constexpr int kHalf = 12;
  static constexpr int kSide = 2 * kHalf;
  static constexpr std::size_t kBuckets = static_cast<std::size_t>(kSide) * kSide;
  /// Of the bucket along one axis; may lie outside.
  [[nodiscard]] int index_of(double offset) const;
  [[nodiscard]] static std::size_t bucket_at(int column, int row) {
    return static_cast<std::size_t>(row * kSide + column);
  }

  Point2 middle_;
  double near_;
  std::array<std::uint32_t, kBuckets + 2> starts_{};  ///< of each bucket in `points_`; in the last, those left out
  std::vector<Point2> points_;                        ///< by buckets, row by row
};

}  // namespace docent::collision_avoidance
