#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "docent/localization/expected_ranges/range_table.h"
#include "docent/sensor_models/proximity_model.h"
#include "docent/sensor_models/range_sweep.h"

namespace docent::localization {

/// The part of the belief that matters: states with at least `fraction` of the peak's probability.
struct LikelyState {
  std::int32_t place = 0;
  std::int32_t heading = 0;
  float mass = 0.0F;  ///< normalised over the list
};

/// What the belief expects in every direction from the robot: a histogram of expected ranges. All that the filters of
/// [Markov1998] 3.3 need of the belief, gathered once for all beams.
class ExpectedRanges {
 public:
  /// `for_entropy`: entropy_gain() will be asked. O(states * directions). @pre states is not empty
  ExpectedRanges(std::span<const LikelyState> states, const RangeTable& table, int directions, bool for_entropy);

  /// P_short(d), eq. 8: the mean of eq. 7 over the belief.
  [[nodiscard]] double shorter(int direction, std::span<const float> shorter_probabilities) const;
  /// Delta H(L | s), eq. 6 [nat]: how much surer the robot gets by the reading whose ln P(d | o) are given.
  /// @pre for_entropy
  [[nodiscard]] double entropy_gain(int direction, std::span<const float> log_probabilities) const;
  /// Mass of the states that expect each range.
  [[nodiscard]] std::span<const float> masses(int direction) const { return of(mass_, direction); }

 private:
  [[nodiscard]] std::span<const float> of(const std::vector<float>& all, int direction) const {
    return std::span{all}.subspan(static_cast<std::size_t>(direction) * sensor_models::kExpectedRanges,
                                  sensor_models::kExpectedRanges);
  }
  std::vector<float> mass_;      ///< [directions][kExpectedRanges]: sum of p
  std::vector<float> log_mass_;  ///< [directions][kExpectedRanges]: sum of p ln p; empty unless for_entropy
  double entropy_ = 0.0;         ///< [nat] of the list
};

/// What a beam measured: one of kMeasurements.
[[nodiscard]] inline int bin_of(const sensor_models::SweepBeam& beam, const sensor_models::ProximityModel& model) {
  return beam.no_return ? model.nothing_up_to(beam.range) : model.bin(beam.range);
}

/// H(L | s) - H(L) [nat] of every beam, [Rhino1999] eq. 10: what its inverse filter asks. 0 without a return: dark
/// things and mirrors are no people. `seen`: in the frame of the belief. O(beams * kExpectedRanges).
[[nodiscard]] std::vector<float> entropy_gains(const ExpectedRanges& expected,
                                               const sensor_models::ProximityModel& model,
                                               const sensor_models::RangeSweep& seen, int headings);

}  // namespace docent::localization
