#pragma once

#include <cmath>

#include "docent/geometry/angle.h"

namespace docent {

/// A point of the plane, or a vector.
struct Point2 {
  double x = 0.0;  ///< [m]; the variable's name says the frame
  double y = 0.0;  ///< [m]
  friend Point2 operator+(Point2 a, Point2 b) { return {a.x + b.x, a.y + b.y}; }          ///< the sum of vectors
  friend Point2 operator-(Point2 a, Point2 b) { return {a.x - b.x, a.y - b.y}; }          ///< the vector from b to a
  friend Point2 operator*(double scale, Point2 a) { return {scale * a.x, scale * a.y}; }  ///< a vector, scaled
  friend bool operator==(const Point2&, const Point2&) = default;
};

[[nodiscard]] inline double dot(Point2 a, Point2 b) { return a.x * b.x + a.y * b.y; }  ///< scalar product
/// > 0: b lies to the left of a
[[nodiscard]] inline double cross(Point2 a, Point2 b) { return a.x * b.y - a.y * b.x; }
/// Not std::hypot: metres neither overflow nor vanish, and this is a tenth of its time.
[[nodiscard]] inline double norm(Point2 a) { return std::sqrt(a.x * a.x + a.y * a.y); }
[[nodiscard]] inline double distance(Point2 a, Point2 b) { return norm(a - b); }  ///< [m]
/// From one point to another, counter-clockwise from the x axis.
[[nodiscard]] inline Angle direction(Point2 from, Point2 to) {
  return Angle::radians(std::atan2(to.y - from.y, to.x - from.x));
}
/// The vector of length 1.
[[nodiscard]] inline Point2 unit(Angle heading) { return {std::cos(heading.radians()), std::sin(heading.radians())}; }

/// Rigid motion of the plane, an element of SE(2). `a_from_b * b_from_c` is `a_from_c`: inner names must meet.
struct Pose2 {
  double x = 0.0;  ///< [m]
  double y = 0.0;  ///< [m]
  Angle theta{};   ///< counter-clockwise from the x axis

  [[nodiscard]] Point2 position() const { return {x, y}; }  ///< the origin of b in a
  /// Takes a point from frame b to frame a.
  friend Point2 operator*(const Pose2& a_from_b, Point2 in_b) {
    const double c = std::cos(a_from_b.theta.radians());
    const double s = std::sin(a_from_b.theta.radians());
    return {a_from_b.x + c * in_b.x - s * in_b.y, a_from_b.y + s * in_b.x + c * in_b.y};
  }
  /// `a_from_c`: one motion after the other.
  friend Pose2 operator*(const Pose2& a_from_b, const Pose2& b_from_c) {
    const auto [px, py] = a_from_b * Point2{b_from_c.x, b_from_c.y};
    return {px, py, a_from_b.theta + b_from_c.theta};
  }
};

/// `b_from_a` of `a_from_b`.
[[nodiscard]] inline Pose2 inverse(const Pose2& a_from_b) {
  const double c = std::cos(a_from_b.theta.radians());
  const double s = std::sin(a_from_b.theta.radians());
  return {-c * a_from_b.x - s * a_from_b.y, s * a_from_b.x - c * a_from_b.y, -a_from_b.theta};
}

}  // namespace docent
