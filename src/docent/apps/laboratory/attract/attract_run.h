#pragma once

#include <optional>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/interaction/attract/attraction.h"
#include "docent/interaction/attract/style_statistics.h"
#include "docent/simulator/passers_by/passers_by.h"

namespace docent::apps::attract_command {

/// What people like; the learner is not told.
enum class CrowdTaste { friendly, upset, neither };
constexpr auto words_of(CrowdTaste) { return std::array{"friendly", "upset", "neither"}; }

struct AttractRunOptions {
  std::uint64_t seed = 1;
  int trials = 201;  ///< phases of a minute, as many as Minerva had ([Minerva2000] 6.3)
  CrowdTaste taste = CrowdTaste::friendly;
  double liking = 1.5;  ///< >= 0, how much they like it: PassersByParams::liking, with the sign of the taste
  interaction::AttractionParams learner;
  interaction::TrialMemory memory;  ///< what was learned before
};

/// A phase as it was, beside what the learner remembers of it.
struct AttractPhase {
  interaction::AttractionTrial trial;  ///< with the true reward
  double friendly_best = 0.0;          ///< share of the best known actions that are friendly, fairly or not
};

struct AttractRunOutcome {
  std::vector<AttractPhase> phases;
  interaction::TrialMemory memory;
  interaction::StyleClaim claim = interaction::StyleClaim::none;
  int claimed_after = 0;         ///< trials; 0: no claim
  double difference = 0.0;       ///< friendly minus upset, mean reward in standard deviations of its crowd
  double friendly_at_end = 0.0;  ///< share of the last third of the phases in which the best known action was friendly
  double last_reward = 0.0;      ///< mean true reward of the last third
};

/// Mingling phases before a hidden crowd. The densities are those of the three crowds of the museums, with their
/// spread. Deterministic by the seed.
[[nodiscard]] AttractRunOutcome run_attract(const AttractRunOptions& options);

}  // namespace docent::apps::attract_command
