#pragma once

#include <cstddef>
#include <vector>

#include "docent/base/result.h"
#include "docent/localization/particles/particle_set.h"

namespace docent::localization {

/// Systematic resampling, step 1 of [Minerva2000] 3.3: appends `count` particles to `to`, drawn from the particles
/// first … last - 1 of `from` by their weights. Each is drawn its expected number of times, rounded up or down, with
/// the expectation kept. All new ones weigh the same and together as much as the old ones did. One uniform draw
/// `offset` 0..1 serves all. O(old + count). @pre their mass is > 0
void resample(const ParticleSet& from, std::size_t first, std::size_t last, std::size_t count, double offset,
              ParticleSet& to);

/// As resample, but a particle is drawn by the square root of its weight, and its copies share what it weighed: what is
/// a ten-thousandth as likely gets a hundredth of the copies. For rivals of which one may yet turn out to be the truth.
void resample_flattened(const ParticleSet& from, std::size_t first, std::size_t last, std::size_t count, double offset,
                        ParticleSet& to);

/// 1 / sum of squared normalised weights: how many equal particles would be worth as much. 0 without mass. O(n).
[[nodiscard]] double effective_size(const ParticleSet& particles, std::size_t first, std::size_t last);

/// How finely KLD-sampling sees the poses, and how well it wants the particles to cover them.
struct KldParams {
  double cell_size = 0.25;     ///< [m], > 0
  double heading_step = 10.0;  ///< [deg], > 0
  double error = 0.05;         ///< > 0: of the Kullback-Leibler distance [nat], not surpassed
  double quantile = 2.33;      ///< of the normal distribution: with 99 % probability
  template <class V>
  void visit(V& v) {
    v("cell_size", cell_size);
    v("heading_step", heading_step);
    v("error", error);
    v("quantile", quantile);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// Number of samples for a distribution over `bins` bins ([Fox2001] eq. 7; the Wilson-Hilferty approximation of the
/// chi-square quantile). 1 for one bin.
[[nodiscard]] std::size_t kld_sample_size(std::size_t bins, const KldParams& params);

/// Bins of which the particles first … last - 1 hold enough that a draw of as many particles would likely hit them.
/// O(n log n), deterministic.
[[nodiscard]] std::size_t occupied_bins(const ParticleSet& particles, std::size_t first, std::size_t last,
                                        const KldParams& params);

}  // namespace docent::localization
