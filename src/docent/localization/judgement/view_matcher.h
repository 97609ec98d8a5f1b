#pragma once

#include "docent/motion_models/odometry_model.h"
#include "docent/sensor_models/range_sweep.h"
#include "docent/sensor_models/ray_caster.h"

namespace docent::localization {

/// How far a guess of a pose may be off.
struct GuessError {
  double position = 0.0;  ///< [m] deviation along each axis
  double heading = 0.0;   ///< [rad] deviation
};

/// Of a pose that was matched: a drawn map is some centimetres off.
inline constexpr GuessError kMatchError{0.1, 0.03};

/// Of a pose that odometry has carried on by `step` from one that was matched.
[[nodiscard]] GuessError guess_error(const motion_models::OdometryModelParams& motion, const Pose2& step);

/// Whether two ways that came to these poses have met: within half a metre and 15 degrees.
[[nodiscard]] bool is_same_place(const Pose2& a, const Pose2& b);

/// At most so many beams of a sweep, spread evenly.
[[nodiscard]] sensor_models::RangeSweep thinned(const sensor_models::RangeSweep& sweep, int most);

/// The pose near `guess` from which the readings of a sweep end nearest to walls, the guess's own density included: a
/// few poses about it are tried, then steps are halved from the best (Hooke and Jeeves). Score as in `best_pose_near`,
/// which is exhaustive and some fifty times as dear. O(beams).
[[nodiscard]] Pose2 matched(const sensor_models::RayCaster& caster, const sensor_models::RangeSweep& sweep,
                            double max_range, const Pose2& guess, const GuessError& error);

}  // namespace docent::localization
