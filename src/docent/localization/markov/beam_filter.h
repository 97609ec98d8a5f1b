#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "docent/base/random.h"
#include "docent/localization/belief/verdict.h"
#include "docent/localization/markov/position_belief.h"
#include "docent/localization/markov/range_table.h"
#include "docent/sensor_models/proximity_model.h"
#include "docent/sensor_models/range_sweep.h"

namespace docent {

/// The part of the belief that matters: states with at least `fraction` of the peak's probability.
struct LikelyState {
  std::int32_t place = 0;
  std::int32_t heading = 0;
  float mass = 0.0F;  ///< normalised over the list
};
/// Empty when there are more than `limit`: the belief is not concentrated.
[[nodiscard]] std::vector<LikelyState> likely_states(const PositionBelief& belief, double fraction, std::size_t limit);

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
    return std::span{all}.subspan(static_cast<std::size_t>(direction) * kExpectedRanges, kExpectedRanges);
  }
  std::vector<float> mass_;      ///< [directions][kExpectedRanges]: sum of p
  std::vector<float> log_mass_;  ///< [directions][kExpectedRanges]: sum of p ln p; empty unless for_entropy
  double entropy_ = 0.0;         ///< [nat] of the list
};

/// none; entropy: [Rhino1999] 3.1.6, any sensor; distance: [Markov1998] 3.3, proximity sensors; novelty: the entropy
/// filter, but only readings that are shorter than expected are rejected (our reading of the filter that [Rhino1999] 9
/// announces): a surprise that people cannot have made is kept.
enum class BeamFilter { none, entropy, distance, novelty };
[[nodiscard]] Result<BeamFilter> beam_filter_of(const std::string& name);
/// Whether it asks ExpectedRanges::entropy_gain().
[[nodiscard]] inline bool asks_entropy(BeamFilter filter) {
  return filter == BeamFilter::entropy || filter == BeamFilter::novelty;
}
/// Whether a filter rejects a reading. `sureness` (theta of [Markov1998] 3.3, e.g. 0.99) is the distance filter's.
[[nodiscard]] bool rejects(BeamFilter filter, const ExpectedRanges& expected, const ProximityModel& model,
                           int direction, int measured, double sureness);

[[nodiscard]] inline int bin_of(const SweepBeam& beam, const ProximityModel& model) {
  return beam.no_return ? kNoReturn : model.bin(beam.range);
}

/// Which beams of a sweep count.
struct BeamChoice {
  std::vector<BinnedBeam> used;  ///< by rising direction
  std::size_t filtered = 0;
  Agreement readings;  ///< of all beams, used or not
};
struct BeamChoiceParams {
  BeamFilter filter = BeamFilter::none;
  double sureness = 0.99;
  double unfiltered_share = 0.1;  ///< of the filtered beams, chosen at random, that count anyway: for recovery
  std::size_t most = 60;
  /// Beams rejected in a crowd are people. Where there are more of them than others the random set, too, would be
  /// mostly people: then it is a share of the others. Not while the robot may be elsewhere, when most beams are
  /// rejected and right. See Verdict::keeps_its_place.
  bool keeps_its_place = false;
  /// [beams of the sweep] 1: on what is shaped like a person, see on_person_shapes; empty: nobody looked. Such a beam
  /// counts with the probability `person_share`, whatever the belief says, and tells nothing of agreement.
  std::vector<std::uint8_t> on_persons{};
  double person_share = 0.1;
};
/// Without likely states no filter can be asked, and all other beams count. `phase`: see `thinned`.
[[nodiscard]] BeamChoice chosen_beams(std::span<const LikelyState> likely, const RangeTable& table, int directions,
                                      const ProximityModel& model, const RangeSweep& sweep,
                                      const BeamChoiceParams& params, std::size_t phase, Rng& rng);

/// H(L | s) - H(L) [nat] of every beam, [Rhino1999] eq. 10: what its inverse filter asks. 0 without a return: dark
/// things and mirrors are no people. `seen`: in the frame of the belief. O(beams * kExpectedRanges).
[[nodiscard]] std::vector<float> entropy_gains(const ExpectedRanges& expected, const ProximityModel& model,
                                               const RangeSweep& seen, int headings);

/// How a reading compares with what the belief expects; surely: with `sureness`, e.g. 0.99.
[[nodiscard]] Agreement agreement(const ExpectedRanges& expected, const ProximityModel& model, int direction,
                                  int measured, double sureness);
/// Summed over all beams of a sweep: agrees + shorter + longer = beams whose range the map says.
[[nodiscard]] Agreement agreement_of_all(const ExpectedRanges& expected, const ProximityModel& model,
                                         const RangeSweep& sweep, double sureness, int directions);

}  // namespace docent
