#include "docent/localization/particles/particle_strata.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace docent::localization {

namespace {

using Resampler = void (*)(const ParticleSet&, std::size_t, std::size_t, std::size_t, double, ParticleSet&);

/// Sorts the particles near `likeliest` to the front; their number.
std::size_t gather_near(ParticleSet& particles, const Pose2& likeliest, ParticleSet& scratch) {
  constexpr float kRadius = 0.75F;      // [m], as the focus of the evidence
  constexpr float kLeastCosine = 0.9F;  // of 26 degrees
  const auto x = static_cast<float>(likeliest.x);
  const auto y = static_cast<float>(likeliest.y);
  const Point2 heading = unit(likeliest.theta);
  const auto hx = static_cast<float>(heading.x);
  const auto hy = static_cast<float>(heading.y);
  const auto is_near = [&](std::size_t i) {
    const float dx = particles.x[i] - x;
    const float dy = particles.y[i] - y;
    return dx * dx + dy * dy <= kRadius * kRadius &&
           particles.heading_x[i] * hx + particles.heading_y[i] * hy >= kLeastCosine;
  };
  scratch.resize(particles.size());
  std::size_t next = 0;
  for (std::size_t i = 0; i < particles.size(); ++i)
    if (is_near(i)) scratch.copy(particles, i, next++);
  const std::size_t near = next;
  for (std::size_t i = 0; i < particles.size(); ++i)
    if (!is_near(i)) scratch.copy(particles, i, next++);
  std::swap(particles, scratch);
  return near;
}

/// Appends particles first … last - 1 to `to`: resampled when they have become uneven, too many or too few.
void resample_stratum(const ParticleSet& particles, std::size_t first, std::size_t last, std::size_t wanted,
                      double resample_below, Resampler resampler, Rng& rng, ParticleSet& to) {
  if (last == first || !(particles.mass(first, last) > 0.0)) return;
  const auto count = static_cast<double>(last - first);
  const bool is_uneven = effective_size(particles, first, last) < resample_below * count;
  const bool has_other_size = count > 1.5 * static_cast<double>(wanted) || 1.5 * count < static_cast<double>(wanted);
  if (is_uneven || has_other_size) {
    resampler(particles, first, last, wanted, rng.uniform(), to);
    return;
  }
  const std::size_t begin = to.size();
  to.resize(begin + (last - first));
  for (std::size_t i = first; i < last; ++i) to.copy(particles, i, begin + (i - first));
}

}  // namespace

void resample_strata(ParticleSet& particles, const Pose2& likeliest, const Strata& strata, Rng& rng,
                     ParticleSet& scratch) {
  const std::size_t near = gather_near(particles, likeliest, scratch);
  const std::size_t all = particles.size();
  const std::size_t bins = occupied_bins(particles, 0, all, strata.kld);
  const std::size_t wanted =
      std::clamp(kld_sample_size(bins, strata.kld), strata.least, std::max(strata.least, strata.most));
  const double near_mass = particles.mass(0, near);
  const double share = near_mass / (near_mass + particles.mass(near, all));
  const auto part = [wanted](double of) {
    return static_cast<std::size_t>(std::lround(of * static_cast<double>(wanted)));
  };
  const std::size_t far_wanted = std::max(part(1.0 - share), std::min(all - near, strata.reserve));
  scratch.clear();
  resample_stratum(particles, 0, near, std::max(strata.least, part(share)), strata.resample_below, &resample, rng,
                   scratch);
  resample_stratum(particles, near, all, far_wanted, strata.resample_below, &resample_flattened, rng, scratch);
  std::swap(particles, scratch);
}

}  // namespace docent::localization
