#include "docent/localization/expected_ranges/agreement.h"

#include <algorithm>

namespace docent {

Agreement& Agreement::operator+=(const Agreement& other) {
  agrees += other.agrees;
  shorter += other.shorter;
  longer += other.longer;
  return *this;
}

Agreement agreement(const ExpectedRanges& expected, const ProximityModel& model, int direction, int measured,
                    double sureness) {
  Agreement result;
  if (measured == kNoReturn) return result;
  const auto masses = expected.masses(direction);
  const auto shorter = model.shorter_probabilities(measured);
  // P_m of this range and all behind it is P_short of the range before.
  const auto not_longer = model.shorter_probabilities(std::max(measured - 1, 0));
  for (std::size_t o = 0; o < kUnknownRange; ++o) {
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

Agreement agreement_of_all(const ExpectedRanges& expected, const ProximityModel& model, const RangeSweep& sweep,
                           double sureness, int directions) {
  Agreement sum;
  for (const BinnedBeam& beam : binned(sweep, directions)) {
    sum += agreement(expected, model, beam.direction, bin_of(sweep.beams[beam.beam], model), sureness);
  }
  return sum;
}

}  // namespace docent
