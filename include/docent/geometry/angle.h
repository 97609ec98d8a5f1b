#pragma once

#include <cmath>
#include <numbers>

namespace docent {

inline constexpr double kDegree = std::numbers::pi / 180.0;    // [rad]
inline constexpr double kRightAngle = std::numbers::pi / 2.0;  // [rad]

/// Planar angle [rad], always wrapped to [-pi, pi).
class Angle {
 public:
  constexpr Angle() = default;
  [[nodiscard]] static Angle radians(double value) {
    constexpr double kTurn = 2.0 * std::numbers::pi;
    const double wrapped = value - kTurn * std::floor((value + std::numbers::pi) / kTurn);
    return Angle{wrapped < std::numbers::pi ? wrapped : -std::numbers::pi};  // rounding may land on +pi
  }
  [[nodiscard]] static Angle degrees(double value) { return radians(value * std::numbers::pi / 180.0); }
  [[nodiscard]] double radians() const { return value_; }
  [[nodiscard]] double degrees() const { return value_ * 180.0 / std::numbers::pi; }
  friend Angle operator+(Angle a, Angle b) { return radians(a.value_ + b.value_); }
  friend Angle operator-(Angle a, Angle b) { return radians(a.value_ - b.value_); }
  friend Angle operator-(Angle a) { return radians(-a.value_); }

 private:
  explicit constexpr Angle(double value) : value_{value} {}
  double value_ = 0.0;
};

}  // namespace docent
