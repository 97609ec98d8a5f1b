#pragma once

#include <optional>
#include <span>

#include "docent/interaction/attract/action_values.h"
#include "docent/interaction/attract/proximity_reward.h"
#include "docent/interaction/attract/style_evidence.h"

namespace docent::interaction {

/// How the robot learns to attract people ([Minerva2000] 6.3).
struct AttractionParams {
  ProximityRewardParams reward;
  ActionChoiceParams choice;
  StyleEvidenceParams evidence;
  CrowdClassParams crowd;  ///< what counts as quiet, busy and packed
  template <class V>
  void visit(V& v) {
    v("reward", reward);
    v("choice", choice);
    v("evidence", evidence);
    v("crowd", crowd);
  }
  [[nodiscard]] Result<void> validate() const;
  bool ignores_reward = false;  ///< crippled: remembers each phase as worth nothing
};

/// The learner: one phase after the other, each with an action that is chosen by all that were before.
///
///   const AttractionAction action = attraction.begin(now, density);  // look, smile and speak so, about a minute
///   attraction.observe(people, now);                                 // as often as people are seen
///   if (attraction.finish(now)) save_trials(file, attraction.trials());
///
/// Deterministic: the n-th remembered phase draws from a stream of its own, so that a restart changes nothing.
class Attraction {
 public:
  /// @param trials  what was remembered; in their order
  Attraction(const AttractionParams& params, TrialMemory trials, const Rng& rng);

  /// A phase begins; one under way is forgotten. @param density [1/m2] persons around
  /// O(trials + actions^2).
  [[nodiscard]] AttractionAction begin(Time now, double density);
  /// People while it lasts: [m], robot frame. Without a phase nothing happens.
  void observe(std::span<const Point2> people, Time now);
  [[nodiscard]] bool is_under_way() const { return phase_.has_value(); }
  /// The phase ends and is remembered, unless the memory is full. @returns its reward; nullopt: there was no phase, or
  /// people were looked for in too little of it, and then it is forgotten.
  std::optional<double> finish(Time now);

  /// What it could do at a density if it did not explore: the best known action, and all that are as good.
  /// O(trials + actions^2).
  [[nodiscard]] std::vector<AttractionAction> best_known(double density) const;
  [[nodiscard]] const TrialMemory& trials() const { return trials_; }
  /// Whether friendly styles attract more people, or fewer; none until it is more than chance.
  [[nodiscard]] const StyleEvidence& evidence() const { return evidence_; }

 private:
  struct Phase {
    AttractionTrial trial;
    PhaseReward reward;
  };

  AttractionParams params_;
  TrialMemory trials_;
  Rng rng_;
  StyleEvidence evidence_;
  std::optional<Phase> phase_;
};

}  // namespace docent::interaction
