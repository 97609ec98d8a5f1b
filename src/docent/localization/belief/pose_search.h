#pragma once

#include <optional>
#include <span>

#include "docent/geometry/pose2.h"
#include "docent/sensor_models/range_sweep.h"
#include "docent/sensor_models/ray_caster.h"

namespace docent::localization {

/// Where a pose may be: a Gaussian, with tails so heavy that it rules nothing out for certain.
struct PoseGuess {
  Pose2 map_from_robot;
  double position_deviation = 0.0;  ///< [m], > 0, along each axis
  double heading_deviation = 0.0;   ///< [rad], > 0
};

/// What a search found.
struct FoundPose {
  Pose2 map_from_robot;
  /// 0..1, of all poses searched, weighed by their scores, that are the same place (same_place); 0: nothing was
  /// searched
  double share = 0.0;
};

/// The pose near the guesses from which the readings of a sweep end nearest to walls: an exhaustive search in steps of
/// 10 cm and a degree over a box about each (three deviations, at most 2 m and 20 degrees), for when
/// nothing foretells the pose well enough to follow a gradient. Score: the sum over the readings of the log of a
/// Gaussian of the distance to the nearest wall, mixed with a constant for what is not in the map, and the guesses' log
/// densities. `readings`: how many independent ones all readings are worth, > 0. Readings from `max_range` [m] on are
/// left out. The first guess where fewer than ten readings remain. O(poses in the boxes * readings), at most 80
/// readings.
/// @pre guesses is not empty
[[nodiscard]] FoundPose best_pose_near(std::span<const PoseGuess> guesses, const sensor_models::RangeSweep& sweep,
                                       const sensor_models::RayCaster& caster, double max_range, double readings);

/// How well the readings of a sweep fit a pose: the score of `best_pose_near` without guesses, a reading; higher is
/// better. None where fewer than ten readings remain. O(beams).
[[nodiscard]] std::optional<double> log_fit(const Pose2& map_from_robot, const sensor_models::RangeSweep& sweep,
                                            const sensor_models::RayCaster& caster, double max_range);

}  // namespace docent::localization
