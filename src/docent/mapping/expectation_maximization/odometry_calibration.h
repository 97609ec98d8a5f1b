#pragma once

#include <span>
#include <vector>

#include "docent/mapping/expectation_maximization/em_mapper.h"

namespace docent::mapping {

/// How the odometry of a drive errs all along, and what is left then. A veer of three degrees a metre, as real wheels
/// have it, would take a blind robot once around in a hundred metres; a belief as wide as that would hold everything.
struct OdometryCalibration {
  double way_scale = 1.0;        ///< true way over odometry's
  double turn_scale = 1.0;       ///< true turn over odometry's
  double veer = 0.0;             ///< [rad/m] more
  double way_per_metre = 0.0;    ///< [m2/m], of what is left, by the way,
  double way_per_radian = 0.0;   ///< [m2/rad], and by the turn
  double turn_per_metre = 0.0;   ///< [rad2/m]
  double turn_per_radian = 0.0;  ///< [rad2/rad]
};

/// Least squares over pieces of the way of `piece` [m] or [rad]: `before_from_after[i]` is how scan i + 1 truly lay to
/// scan i, as their match says. Where the pieces are too few, no correction and the given noise. O(scans).
[[nodiscard]] OdometryCalibration calibrate_odometry(std::span<const MappingScan> scans,
                                                     std::span<const Pose2> before_from_after,
                                                     const EmMapperParams& params);

/// The same scans with the odometry that such a robot would have read if it did not err all along.
[[nodiscard]] std::vector<MappingScan> with_odometry_corrected(std::span<const MappingScan> scans,
                                                               const OdometryCalibration& calibration);

}  // namespace docent::mapping
