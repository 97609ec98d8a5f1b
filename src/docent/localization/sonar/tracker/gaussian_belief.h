#pragma once

#include "docent/grid/occupancy_grid.h"
#include "docent/localization/belief/belief_summary.h"
#include "docent/localization/sonar/tracker/drift_filter.h"

namespace docent::localization {

/// A Gaussian as a belief (architecture 10.5): one mode, and 343 poses on a lattice of its axes up to three deviations.
/// @param p_lost  0..1: what the Gaussian does not hold; spread evenly over the free floor of `map`, in cells of 1 m
[[nodiscard]] BeliefSummary gaussian_belief(const Pose2& mean, const PoseMatrix& covariance, double p_lost,
                                            const OccupancyGrid& map);

}  // namespace docent::localization
