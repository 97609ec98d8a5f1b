#pragma once

#include <cstdint>
#include <vector>

#include "docent/localization/belief/belief_summary.h"
#include "docent/localization/expected_ranges/expected_ranges.h"
#include "docent/localization/markov/position_belief.h"

namespace docent::localization {

/// The coarse cells on which a summary adds up what it does not list, and the places in them. Made once for a space.
struct CoarseCells {
  /// `size` [m]
  CoarseCells(const StateSpace& space, double size);
  Point2 origin;  ///< lower left corner [m]
  double size;    ///< [m]
  int columns, rows;
  std::vector<std::int32_t> of_place;  ///< [places]
  std::vector<std::int32_t> places;    ///< [rows * columns] how many lie in each
};

/// Of the robot's pose, where the belief is over a frame with `frame_from_robot`. O(kept states).
/// @pre `coarse` is of the belief's space and `params.rest_cell_size`
[[nodiscard]] BeliefSummary summarise(const PositionBelief& belief, const CoarseCells& coarse,
                                      const Pose2& frame_from_robot, const SummaryParams& params);

/// States with at least `fraction` of the peak's probability.
/// Empty when there are more than `limit`: the belief is not concentrated.
[[nodiscard]] std::vector<LikelyState> likely_states(const PositionBelief& belief, double fraction, std::size_t limit);

}  // namespace docent::localization
