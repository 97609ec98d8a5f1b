#include "docent/localization/expected_ranges/agreement.h"

#include <algorithm>

namespace docent::localization {

Agreement& Agreement::operator+=(const Agreement& other) {
  agrees += other.agrees;
  shorter += other.shorter;
  longer += other.longer;
  return *this;
}

Agreement agreement(const ExpectedRanges& expected, const sensor_models::ProximityModel& model, int direction,
                    int measured, double sureness) {
  Agreement result;
  if (measured == sensor_models::kNoReturn) return result;
  const auto masses = expected.masses(direction);
  if (measured > sensor_models::kNoReturn) {  // what a scanner that looks farther would have seen
    const auto nearest = static_cast<std::size_t>(measured - sensor_models::kRangeBins) + 1;
    for (std::size_t o = nearest; o < sensor_models::kNoReturn; ++o) result.agrees += static_cast<double>(masses[o]);
    return result;
  }
  const auto shorter = model.shorter_probabilities(measured);
  // P_m of this range and all behind it is P_short of the range before.
  const auto not_longer = model.shorter_probabilities(std::max(measured - 1, 0));
  for (std::size_t o = 0; o < sensor_models::kUnknownRange; ++o) {
    const double mass = static_cast<double>(masses[o]);
    if (static_cast<double>(shorter[o]) > sureness) {
      result.shorter += mass;
    } else if (measured > 0 && static_cast<double>(not_longer[o]) < 1.0 - sureness) {
      result.longer += mass;
    } else {
      result.agrees += mass;
    }
  }
  return result;
}

Agreement agreement_of_all(const ExpectedRanges& expected, const sensor_models::ProximityModel& model,
                           const sensor_models::RangeSweep& sweep, double sureness, int directions) {
  Agreement sum;
  for (const sensor_models::BinnedBeam& beam : sensor_models::binned(sweep, directions)) {
    sum += agreement(expected, model, beam.direction, bin_of(sweep.beams[beam.beam], model), sureness);
  }
  return sum;
}

}  // namespace docent::localization
