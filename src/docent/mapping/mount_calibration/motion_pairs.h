#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "docent/base/time.h"
#include "docent/motion_models/odometry_history.h"

namespace docent::mapping {

/// The motion of a base between two moments, as odometry has it if a scanner's stamps are late by so much.
class ShiftedMotion {
 public:
  static constexpr double kStep = 0.05;         ///< [s]
  static constexpr int kShifts = 15;            ///< of the stamps, from early to late
  static constexpr double kMost = 7.0 * kStep;  ///< [s]: delays of -kMost to kMost can be told

  /// None: odometry of then is not known.
  [[nodiscard]] static std::optional<ShiftedMotion> between(const motion_models::OdometryHistory& odometry, Time from,
                                                            Time to);
  /// base_then_from_base_now, for stamps that are late by `delay` [s]; interpolated.
  [[nodiscard]] Pose2 at(double delay) const;
  /// For tests: the same motion, whatever the delay.
  [[nodiscard]] static ShiftedMotion constant(const Pose2& motion);

 private:
  std::array<Pose2, kShifts> motions_;
};

/// Two sweeps of one scanner that were laid onto each other, and what odometry says of the way between.
struct MotionPair {
  Pose2 sensor_then_from_now;   ///< by the scans alone
  Eigen::Matrix3d information;  ///< of it: inverse covariance of (x, y, theta), seen in the later sweep's frame
  ShiftedMotion base;           ///< by odometry alone
};

}  // namespace docent::mapping
