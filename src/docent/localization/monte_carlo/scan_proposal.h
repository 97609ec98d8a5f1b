#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "docent/base/random.h"
#include "docent/localization/expected_ranges/range_table.h"
#include "docent/localization/expected_ranges/state_space.h"
#include "docent/localization/markov/score_kernel.h"
#include "docent/localization/particles/particle_set.h"

namespace docent::localization {

/// Poses drawn from what the sensors see, q(x) ~ p(z | x) (the dual of [ThrunFoxBurgard2000]). There a tree
/// over features stands for p(x | z); here all states of the grid are weighed, which takes some tens of milliseconds.
struct ScanProposal {
  ParticleSet poses;              ///< spread evenly over their cells, weights all 1
  std::vector<float> likelihood;  ///< of each pose: p(z | x) relative to a perfect fit, exp(-cost)
  double mean_likelihood = 0.0;   ///< over all states that were weighed: p(z) of a robot that may be anywhere
};

/// Which tiles of the range table are weighed: first, first + stride, …
struct TileChoice {
  std::size_t first = 0;
  std::size_t stride = 1;
};

/// `beams`: tempered costs by rising direction; the beams of one of `sectors` cost at most `cap` together.
/// O(places / stride * headings * beams + count). Deterministic for the state of `rng`, on every instruction set.
[[nodiscard]] ScanProposal draw_from_scan(const StateSpace& space, const RangeTable& table,
                                          std::span<const BeamCosts> beams, std::size_t sectors, std::uint16_t cap,
                                          std::size_t count, const TileChoice& tiles, InstructionSet set, Rng& rng);

}  // namespace docent::localization
