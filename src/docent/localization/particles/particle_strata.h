#pragma once

#include "docent/base/random.h"
#include "docent/localization/particles/particle_set.h"
#include "docent/localization/particles/resampling.h"

namespace docent::localization {

/// How many particles there may be, and where.
struct Strata {
  std::size_t least = 300;      ///< near the likeliest place
  std::size_t most = 50000;     ///< in all, but for `least` and `reserve`
  std::size_t reserve = 2000;   ///< away from the likeliest place, however little they weigh, if there are any
  double resample_below = 0.5;  ///< of the particles that the weights are worth
  KldParams kld;                ///< how many between least and most
};

/// Resamples, where that is worth while, what lies near the likeliest place and the rest, each as a stratum of its own
/// that keeps its mass. The rest is drawn flattened: a robot in a corridor that repeats has rivals to its likeliest
/// place, and of three hundred particles drawn by weight alone none would be left for one of a thousandth.
/// `scratch`: memory that is kept. O(n log n).
void resample_strata(ParticleSet& particles, const Pose2& likeliest, const Strata& strata, Rng& rng,
                     ParticleSet& scratch);

}  // namespace docent::localization
