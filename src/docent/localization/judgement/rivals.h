#pragma once

#include <optional>
#include <span>
#include <vector>

#include "docent/localization/belief/belief_summary.h"
#include "docent/localization/belief/observation_model.h"
#include "docent/sensor_models/range_sweep.h"
#include "docent/sensor_models/ray_caster.h"

namespace docent::localization {

/// Places that nothing has told from the best one yet.
///
/// Scans from one spot err together: a wall that the survey has two centimetres off speaks for the wrong one of two
/// places that look the same, in every scan, and the product of likelihoods is sure of it within seconds. So while the
/// robot has no place to keep (Verdict), every place that ever was a mode stays possible until readings differ from it
/// grossly, by more than maps and poses are wrong, where they fit the best place; or until evidence has ruled it out at
/// several spots, each some way from the last. docs/decisions/0010.
class Rivals {
 public:
  /// Takes in the modes of `summary`, carries on the ones it knows, and drops those that the sweep speaks against.
  /// Returns the belief as it should be when evidence has all but ruled out a rival that nothing was seen to speak
  /// against: the best mode and every rival with a fair share. nullopt: it is so already, or the belief is not
  /// concentrated on modes. O(rivals * beams casts).
  [[nodiscard]] std::optional<std::vector<BeliefMode>> update(const BeliefSummary& summary,
                                                              const sensor_models::RangeSweep& sweep,
                                                              const Pose2& before_from_after,
                                                              const sensor_models::RayCaster& caster, double max_range);
  /// What other sensors say of the places besides, for `weight` of an update; after `update`. Whom they have told from
  /// the best place by enough nats gets no fair share any more, until they take it back. O(rivals).
  void hear(const BeliefSummary& summary, const ObservationModels& others, double weight);
  void forget() { places_.clear(); }

 private:
  struct Place {
    BeliefMode mode;
    double against = 0.0;         ///< sweeps that differ from it grossly
    double others_against = 0.0;  ///< [nat] that other sensors say against it, in all
    int outweighed = 0;           ///< spots at which the evidence ruled it out
    double outweighed_at{};       ///< [m] of way_, the last of them
  };
  /// Takes in, carries on and drops.
  void follow(const BeliefSummary& summary, const sensor_models::RangeSweep& sweep, const Pose2& before_from_after,
              const sensor_models::RayCaster& caster, double max_range);
  /// The belief with a fair share for every rival.
  [[nodiscard]] std::optional<std::vector<BeliefMode>> restored(const BeliefSummary& summary);
  void take_in(const BeliefMode& mode, double least_mass);

  std::vector<Place> places_;  ///< the best mode's among them
  double way_ = 0.0;           ///< [m] driven
};

/// Of the beams of a sweep: how many fit the first pose and differ grossly from the second, and the other way round.
struct GrossDifference {
  int first_only = 0;
  int second_only = 0;
  int beams = 0;
};
[[nodiscard]] GrossDifference gross_difference(const sensor_models::RayCaster& caster,
                                               const sensor_models::RangeSweep& sweep, const Pose2& first,
                                               const Pose2& second, double max_range);

}  // namespace docent::localization
