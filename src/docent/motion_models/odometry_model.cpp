#include "docent/motion_models/odometry_model.h"

#include <cmath>

namespace docent::motion_models {

Result<void> OdometryModelParams::validate() const {
  if (!(translation_per_metre > 0.0)) return fail("motion.translation_per_metre must be > 0");
  if (!(translation_per_radian >= 0.0)) return fail("motion.translation_per_radian must be >= 0");
  if (!(rotation_per_metre >= 0.0)) return fail("motion.rotation_per_metre must be >= 0");
  if (!(rotation_per_radian > 0.0)) return fail("motion.rotation_per_radian must be > 0");
  if (!(slip_probability >= 0.0 && slip_probability <= 0.5)) return fail("motion.slip_probability must be 0..0.5");
  return {};
}

MotionNoise motion_noise(const OdometryModelParams& params, const Pose2& before_from_after) {
  const double way = norm(before_from_after.position());
  const double turn = std::abs(before_from_after.theta.radians());
  return {params.translation_per_metre * way + params.translation_per_radian * turn,
          params.rotation_per_metre * way + params.rotation_per_radian * turn};
}

}  // namespace docent::motion_models
