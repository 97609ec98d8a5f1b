#pragma once

#include <array>

#include "docent/geometry/pose2.h"
#include "docent/motion_models/odometry_model.h"

namespace docent::localization {

/// Row-major symmetric 3 x 3 matrix over x [m], y [m], heading [rad].
using PoseMatrix = std::array<double, 9>;

/// Inverse of a symmetric positive definite matrix; of a singular one something finite.
[[nodiscard]] PoseMatrix inverse_of(const PoseMatrix& matrix);
/// value' * matrix * value
[[nodiscard]] double squared_length(const PoseMatrix& matrix, const std::array<double, 3>& value);
/// Difference `to - from`, heading wrapped.
[[nodiscard]] std::array<double, 3> difference(const Pose2& to, const Pose2& from);

/// How wrong odometry can be all day, on top of its noise: standard deviations of what is learned while driving.
struct OdometryDriftParams {
  double scale = 0.015;   ///< > 0: relative error of ways
  double turning = 0.02;  ///< > 0: relative error of turns
  double veer = 0.02;     ///< [rad/m], > 0: a turn that grows with the way (one wheel larger than the other)
  template <class V>
  void visit(V& v) {
    v("scale", scale);
    v("turning", turning);
    v("veer", veer);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// Extended Kalman filter over the pose and three systematic errors of odometry. O(1) a step.
class DriftFilter {
 public:
  DriftFilter(const motion_models::OdometryModelParams& noise, const OdometryDriftParams& drift);

  /// Starts anew at a known pose; what was learned about odometry is kept. @param covariance  of the pose
  void start_at(const Pose2& map_from_robot, const PoseMatrix& covariance);
  /// One increment of odometry. @returns the increment without its systematic errors, as they are known now
  Pose2 move(const Pose2& before_from_after);
  /// Heading measured from outside. @param deviation  [rad]
  void correct_heading(Angle measured, double deviation);
  /// The pose became `posterior`, with `covariance` no larger than the present one; the systematic errors follow by
  /// their correlation with it.
  void correct_pose(const Pose2& posterior, const PoseMatrix& covariance);
  /// Doubt: adds to the variances of the pose. @param position [m], heading [rad]: standard deviations
  void widen(double position, double heading);

  [[nodiscard]] const Pose2& map_from_robot() const { return pose_; }
  [[nodiscard]] PoseMatrix covariance() const;
  [[nodiscard]] double scale() const { return drift_[0]; }    ///< true way = (1 + scale) * odometry's
  [[nodiscard]] double turning() const { return drift_[1]; }  ///< likewise of turns
  [[nodiscard]] double veer() const { return drift_[2]; }     ///< [rad/m]

 private:
  static constexpr std::size_t kStates = 6;  // x, y, heading, scale, turning, veer
  [[nodiscard]] double& at(std::size_t row, std::size_t column) { return covariance_[row * kStates + column]; }
  [[nodiscard]] double at(std::size_t row, std::size_t column) const { return covariance_[row * kStates + column]; }
  void shift(const std::array<double, kStates>& by);

  motion_models::OdometryModelParams noise_;
  Pose2 pose_;
  std::array<double, 3> drift_{};
  std::array<double, kStates * kStates> covariance_{};
};

}  // namespace docent::localization
