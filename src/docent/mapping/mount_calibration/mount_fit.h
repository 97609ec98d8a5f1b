#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "docent/mapping/mount_calibration/calibration_params.h"
#include "docent/mapping/mount_calibration/motion_pairs.h"

namespace docent::mapping {

/// What is estimated of one scanner, and of the base as far as this scanner sees it.
struct MountState {
  Pose2 base_from_sensor;   ///< x, y [m] and heading; the base turns about its origin
  double delay = 0.0;       ///< [s] by which the scanner's stamps are later than odometry's
  double way_scale = 1.0;   ///< true metres for each metre of odometry
  double turn_scale = 1.0;  ///< true radians for each radian of odometry
  double veer = 0.0;        ///< [rad/m] of turn that comes with the way
};

/// Order of the seven unknowns in matrices.
enum MountUnknown { kMountX, kMountY, kMountHeading, kMountDelay, kWayScale, kTurnScale, kVeer, kMountUnknowns };
using MountMatrix = Eigen::Matrix<double, kMountUnknowns, kMountUnknowns>;
using MountVector = Eigen::Matrix<double, kMountUnknowns, 1>;

struct MountPrior {
  MountState state;
  MountVector sigma;  ///< standard deviations; headings in [rad]
};
/// Nothing but what robot.yaml says.
[[nodiscard]] MountPrior vague_prior(const Pose2& base_from_sensor, const MountFitParams& params);

struct MountEstimate {
  MountState state;
  MountMatrix covariance = MountMatrix::Zero();
  double misfit = 0.0;  ///< mean over pairs of the squared residual in sigmas, each at most 9; some 3 where all is well
  [[nodiscard]] double sigma(MountUnknown unknown) const;
  [[nodiscard]] double sigma_position() const;  ///< [m], of the worse direction's axis
};

/// Squared residual of a pair, in sigmas.
[[nodiscard]] double residual_of(const MotionPair& pair, const MountState& state, const MountFitParams& params);

/// The mount by which the motions of a sensor and those of its base are the same: hand-eye calibration in the plane,
/// A X = X B (R. Tsai and R. Lenz, IEEE T-RA 1989), by least squares with weights that fall with the residual (Cauchy).
/// Straight ways tell the heading, turns the place, changes of the turn rate the delay. Departure: the errors of the
/// base's odometry (J. Borenstein and L. Feng, IEEE T-RA 1996: scales and veer) are unknowns, too. O(pairs).
[[nodiscard]] MountEstimate fit_mount(std::span<const MotionPair> pairs, const MountPrior& prior,
                                      const MountFitParams& params);

}  // namespace docent::mapping
