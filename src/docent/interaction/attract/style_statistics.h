#pragma once

#include <array>
#include <optional>
#include <span>

#include "docent/interaction/attract/crowd_class.h"
#include "docent/interaction/attract/trial_memory.h"

namespace docent::interaction {

/// The rewards of some trials.
struct RewardStatistic {
  int count = 0;
  double mean = 0.0;  ///< 0 of none
  std::optional<double>
      half_width;  ///< of the 95 % interval of the mean, by Student's t; of fewer than two there is none
};

/// A column of [Minerva2000] Fig. 15 for each style, in the order of Style.
using StyleStatistics = std::array<RewardStatistic, kStyles>;

/// @param crowd  trials in such crowds alone; without it, all
/// The intervals describe what was seen. They take the trials of a style for a fair sample, which those of a learner
/// are not: whether styles differ is what StyleEvidence says. O(trials).
[[nodiscard]] StyleStatistics style_statistics(std::span<const AttractionTrial> trials, std::optional<CrowdClass> crowd,
                                               const CrowdClassParams& crowds);

}  // namespace docent::interaction
