#pragma once

#include "docent/sensor_models/range_sweep.h"
#include "docent/sensor_models/ray_caster.h"

namespace docent::localization {

/// How far a guess of a pose may be off.
struct GuessError {
  double position = 0.0;  ///< [m] deviation along each axis
  double heading = 0.0;   ///< [rad] deviation
};

/// The pose near `guess` from which the readings of a sweep end nearest to walls, the guess's own density included: a
/// few poses about it are tried, then steps are halved from the best (Hooke and Jeeves). Score as in `best_pose_near`,
/// which is exhaustive and some fifty times as dear. O(beams).
[[nodiscard]] Pose2 matched(const sensor_models::RayCaster& caster, const sensor_models::RangeSweep& sweep,
                            double max_range, const Pose2& guess, const GuessError& error);

}  // namespace docent::localization
