#pragma once

#include "docent/geometry/pose2.h"
#include "docent/localization/belief/belief_summary.h"

namespace docent::planning {

/// A pose of a normal distribution, the same to all sides.
struct NormalPose {
  Pose2 map_from_base;         ///< its mean
  double sigma = 0.0;          ///< [m], > 0: one standard deviation along each axis
  double sigma_heading = 0.0;  ///< [rad], > 0
};

[[nodiscard]] localization::BeliefMode mode_of(const NormalPose& pose);

/// The pose as a belief in few cells, one deviation apart from each other: all of it counts where hazards are kept off.
[[nodiscard]] localization::BeliefSummary belief_of(const NormalPose& pose);

}  // namespace docent::planning
