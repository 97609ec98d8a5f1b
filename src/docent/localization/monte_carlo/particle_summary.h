#pragma once

#include <vector>

#include "docent/localization/beam_choice/beam_filter.h"
#include "docent/localization/belief/belief_summary.h"
#include "docent/localization/expected_ranges/state_space.h"
#include "docent/localization/particles/particle_set.h"

namespace docent::localization {

/// A state of the grid and the particles in it.
struct ParticleBin {
  CellIndex cell;
  int heading = 0;  ///< [heading steps]
  double mass = 0.0;
  double x = 0.0, y = 0.0, cos = 0.0, sin = 0.0;  ///< sums over the particles, weighed
};
/// In the order of cells and headings. Particles outside the grid count in its border cells. O(n log n).
[[nodiscard]] std::vector<ParticleBin> bins_of(const ParticleSet& particles, const StateSpace& space);

/// What grid and particles publish is alike, but that a cell stands at the mean of its particles. Masses sum to 1.
[[nodiscard]] BeliefSummary summarise(std::vector<ParticleBin> bins, const StateSpace& space,
                                      const SummaryParams& params);

/// Anywhere on the free places, all alike: before the first scan, when there are no particles.
[[nodiscard]] BeliefSummary summarise_unknown(const StateSpace& space, const SummaryParams& params);

/// As likely_states of the grid: states with at least `fraction` of the likeliest one's mass; none when there are more
/// than `limit`. Particles off the free places are left out.
[[nodiscard]] std::vector<LikelyState> likely_states(const std::vector<ParticleBin>& bins, const StateSpace& space,
                                                     double fraction, std::size_t limit);

}  // namespace docent::localization
