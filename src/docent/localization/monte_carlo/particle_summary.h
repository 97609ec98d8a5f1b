#pragma once

#include <vector>

#include "docent/localization/belief/belief_summary.h"
#include "docent/localization/markov/beam_filter.h"
#include "docent/localization/markov/state_space.h"
#include "docent/localization/monte_carlo/particle_set.h"

namespace docent {

/// The particles in the grid's states: what grid and particles publish is alike. A cell stands at the mean of its
/// particles. Their weights sum to 1. O(n log n).
[[nodiscard]] BeliefSummary summarise(const ParticleSet& particles, const StateSpace& space,
                                      const SummaryParams& params);

/// As likely_states of the grid: states with at least `fraction` of the likeliest one's mass; none when there are more
/// than `limit`. Particles off the free places are left out.
[[nodiscard]] std::vector<LikelyState> likely_states(const ParticleSet& particles, const StateSpace& space,
                                                     double fraction, std::size_t limit);

}  // namespace docent
