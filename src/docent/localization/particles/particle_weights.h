#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "docent/localization/belief/neighbourhood.h"
#include "docent/localization/particles/particle_set.h"

namespace docent::localization {

/// How much one scan may count, as the grid's EvidenceWeights: beams and scans err together (decision 0006).
struct ParticleEvidence {
  double nats_per_cost = 1.0 / 24.0;  ///< the tempering
  double most_nats = 60.0;            ///< [nat] that a scan counts at most against the best particle
  /// Particles near it keep all of the evidence among themselves; between them and the others only the far share
  /// counts.
  std::optional<Neighbourhood> focus;
  double far_share = 1.0;  ///< 0..1
  double far_most_nats = 60.0;
};

/// Mean of exp(-nats_per_cost * cost) over the particles; 0 when they have no weight. O(particles).
[[nodiscard]] double mean_likelihood(const ParticleSet& particles, std::span<const std::uint32_t> costs,
                                     double nats_per_cost);

/// Multiplies the weights by the likelihoods exp(-nats_per_cost * cost), step 3 of [Minerva2000] 3.3, and normalises
/// them. Returns the mean likelihood that the particles gave the scan before, as if all evidence counted; 0 when there
/// is no weight at all, and then nothing is changed. O(particles).
double reweigh(ParticleSet& particles, std::span<const std::uint32_t> costs, const ParticleEvidence& evidence);

/// What a search has found inside a neighbourhood; the weight of the neighbourhood as a whole stays. O(particles).
void gather(ParticleSet& particles, const Gathering& gathering);

}  // namespace docent::localization
