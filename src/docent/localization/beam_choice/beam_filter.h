#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "docent/base/random.h"
#include "docent/localization/expected_ranges/agreement.h"
#include "docent/localization/expected_ranges/expected_ranges.h"
#include "docent/localization/expected_ranges/range_table.h"
#include "docent/sensor_models/proximity_model.h"
#include "docent/sensor_models/range_sweep.h"

namespace docent::localization {

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
[[nodiscard]] bool rejects(BeamFilter filter, const ExpectedRanges& expected,
                           const sensor_models::ProximityModel& model, int direction, int measured, double sureness);

/// Which beams of a sweep count.
struct BeamChoice {
  std::vector<sensor_models::BinnedBeam> used;  ///< by rising direction
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
                                      const sensor_models::ProximityModel& model,
                                      const sensor_models::RangeSweep& sweep, const BeamChoiceParams& params,
                                      std::size_t phase, Rng& rng);

}  // namespace docent::localization
