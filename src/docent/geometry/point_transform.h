#pragma once

#include "docent/geometry/pose2.h"

namespace docent {

/// A rigid motion whose cosine and sine are at hand: for many points, bit for bit what the pose makes of each.
class PointTransform {
 public:
  explicit PointTransform(const Pose2& a_from_b) : origin_{a_from_b.position()}, x_axis_{unit(a_from_b.theta)} {}
  friend Point2 operator*(const PointTransform& a_from_b, Point2 in_b) {
    const auto [c, s] = a_from_b.x_axis_;
    return {a_from_b.origin_.x + c * in_b.x - s * in_b.y, a_from_b.origin_.y + s * in_b.x + c * in_b.y};
  }

 private:
  Point2 origin_;
  Point2 x_axis_;
};

}  // namespace docent
