#pragma once

#include "docent/localization/belief/belief_summary.h"
#include "docent/localization/markov/position_belief.h"

namespace docent {

/// Of the robot's pose, where the belief is over a frame with `frame_from_robot`. O(kept states).
[[nodiscard]] BeliefSummary summarise(const PositionBelief& belief, const Pose2& frame_from_robot,
                                      const SummaryParams& params);

}  // namespace docent
