#include "docent/localization/expected_ranges/expected_ranges.h"

#include <cmath>
#include <numbers>

namespace docent::localization {

ExpectedRanges::ExpectedRanges(std::span<const LikelyState> states, const RangeTable& table, int directions,
                               bool for_entropy) {
  const auto count = static_cast<std::size_t>(directions);
  mass_.assign(count * sensor_models::kExpectedRanges, 0.0F);
  if (for_entropy) log_mass_.assign(count * sensor_models::kExpectedRanges, 0.0F);
  for (const LikelyState& state : states) {
    const RangeTable::Row row = table.row(static_cast<std::size_t>(state.place));
    const auto heading = static_cast<std::size_t>(state.heading);
    if (!for_entropy) {
      for (std::size_t d = 0; d < count; ++d)
        mass_[d * sensor_models::kExpectedRanges + row[heading + d]] += state.mass;
      continue;
    }
    const float log_part = state.mass * std::log(state.mass);
    entropy_ -= static_cast<double>(log_part);
    for (std::size_t d = 0; d < count; ++d) {
      const std::size_t i = d * sensor_models::kExpectedRanges + row[heading + d];
      mass_[i] += state.mass;
      log_mass_[i] += log_part;
    }
  }
}

double ExpectedRanges::shorter(int direction, std::span<const float> shorter_probabilities) const {
  const auto mass = of(mass_, direction);
  double sum = 0.0;
  for (std::size_t o = 0; o < sensor_models::kExpectedRanges; ++o)
    sum += static_cast<double>(mass[o] * shorter_probabilities[o]);
  return sum;
}

double ExpectedRanges::entropy_gain(int direction, std::span<const float> log_probabilities) const {
  // With r(o) = P(d | o) and Z = sum r p: H(L | s) = ln Z - 1/Z sum r p (ln r + ln p), and p enters only through its
  // sums over states that expect the same range.
  const auto mass = of(mass_, direction);
  const auto log_mass = of(log_mass_, direction);
  double z = 0.0;
  double sum = 0.0;
  for (std::size_t o = 0; o < sensor_models::kExpectedRanges; ++o) {
    if (mass[o] <= 0.0F) continue;
    const double log_r = static_cast<double>(log_probabilities[o]);
    const double r = std::exp(log_r);
    z += r * static_cast<double>(mass[o]);
    sum += r * (static_cast<double>(log_mass[o]) + log_r * static_cast<double>(mass[o]));
  }
  return entropy_ - (std::log(z) - sum / z);
}

std::vector<float> entropy_gains(const ExpectedRanges& expected, const sensor_models::ProximityModel& model,
                                 const sensor_models::RangeSweep& seen, int headings) {
  std::vector<float> gains(seen.beams.size(), 0.0F);
  const double step = 2.0 * std::numbers::pi / headings;
  for (std::size_t i = 0; i < gains.size(); ++i) {
    const sensor_models::SweepBeam& beam = seen.beams[i];
    if (beam.no_return) continue;
    const int direction = (static_cast<int>(std::lround(beam.bearing / step)) + headings) % headings;
    // ExpectedRanges counts as [Markov1998] does, before minus after.
    gains[i] = static_cast<float>(-expected.entropy_gain(direction, model.log_probabilities(model.bin(beam.range))));
  }
  return gains;
}

}  // namespace docent::localization
