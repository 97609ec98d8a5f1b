#pragma once

#include "docent/base/result.h"
#include "docent/geometry/pose2.h"

namespace docent::motion_models {

/// How much wheel odometry errs. Variances grow with the way, so that it does not matter into how many steps a motion
/// is cut. Departure from [Rhino1999] 3.1.3, where widths are proportional to the length of one command.
struct OdometryModelParams {
  double translation_per_metre = 0.0016;   ///< [m2/m], > 0: 4 cm after a metre
  double translation_per_radian = 0.0001;  ///< [m2/rad], >= 0
  double rotation_per_metre = 0.001;       ///< [rad2/m], >= 0: 1.8 degrees after a metre
  double rotation_per_radian = 0.004;      ///< [rad2/rad], > 0: 3.6 degrees after a radian
  double slip_probability = 0.01;          ///< 0..0.5: a step in which the wheels slip or somebody pushes
  template <class V>
  void visit(V& v) {
    v("translation_per_metre", translation_per_metre);
    v("translation_per_radian", translation_per_radian);
    v("rotation_per_metre", rotation_per_metre);
    v("rotation_per_radian", rotation_per_radian);
    v("slip_probability", slip_probability);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// Error of one odometry increment.
struct MotionNoise {
  double position_variance = 0.0;  ///< [m2] along each axis
  double heading_variance = 0.0;   ///< [rad2]
};

/// The error of the increment `from_base_to_base` (where the robot is now, seen from where it was). O(1).
[[nodiscard]] MotionNoise motion_noise(const OdometryModelParams& params, const Pose2& before_from_after);

}  // namespace docent::motion_models
