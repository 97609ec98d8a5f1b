#pragma once

#include <cmath>
#include <numbers>

namespace docent {

/// One degree [rad].
inline constexpr double kDegree = std::numbers::pi / 180.0;  // [rad]
/// A quarter of a turn [rad].
inline constexpr double kRightAngle = std::numbers::pi / 2.0;  // [rad]

/// Planar angle [rad], always wrapped to [-pi, pi).
class Angle {
 public:
  constexpr Angle() = default;
  /// Any value [rad], wrapped.
  [[nodiscard]] static Angle radians(double value) {
    constexpr double kTurn = 2.0 * std::numbers::pi;
    const double wrapped = value - kTurn * std::floor((value + std::numbers::pi) / kTurn);
    return Angle{wrapped < std::numbers::pi ? wrapped : -std::numbers::pi};  // rounding may land on +pi
  }
  /// Any value [deg], wrapped.
  [[nodiscard]] static Angle degrees(double value) { return radians(value * std::numbers::pi / 180.0); }
  [[nodiscard]] double radians() const { return value_; }                             ///< [-pi, pi)
  [[nodiscard]] double degrees() const { return value_ * 180.0 / std::numbers::pi; }  ///< [-180, 180)
  friend Angle operator+(Angle a, Angle b) { return radians(a.value_ + b.value_); }   ///< wrapped
  friend Angle operator-(Angle a, Angle b) { return radians(a.value_ - b.value_); }   ///< wrapped: the turn from b to a
  friend Angle operator-(Angle a) { return radians(-a.value_); }                      ///< wrapped

 private:
  explicit constexpr Angle(double value) : value_{value} {}
  double value_ = 0.0;
};

}  // namespace docent
