#pragma once

#include <Eigen/Core>
#include <cmath>

#include "docent/geometry/angle.h"

namespace docent::mapping {

/// A covariance of (x, y, theta), or an information matrix, seen from a frame that is turned back by so much.
[[nodiscard]] inline Eigen::Matrix3d turned(const Eigen::Matrix3d& matrix, Angle by) {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  turn(0, 0) = turn(1, 1) = std::cos(by.radians());
  turn(0, 1) = -std::sin(by.radians());
  turn(1, 0) = std::sin(by.radians());
  return turn * matrix * turn.transpose();
}

}  // namespace docent::mapping
