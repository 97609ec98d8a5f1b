#include "docent/interaction/attract/attraction.h"

#include <string>

namespace docent::interaction {

Result<void> AttractionParams::validate() const {
  if (auto valid = reward.validate(); !valid) return valid;
  if (auto valid = choice.validate(); !valid) return valid;
  if (auto valid = evidence.validate(); !valid) return valid;
  return crowd.validate();
}

Attraction::Attraction(const AttractionParams& params, TrialMemory trials, const Rng& rng)
    : params_{params}, trials_{std::move(trials)}, rng_{rng}, evidence_{params.evidence, params.crowd} {
  for (const AttractionTrial& trial : trials_) evidence_.add(trial);
}

AttractionAction Attraction::begin(Time now, double density) {
  const PerAction values = action_values(trials_, density, params_.choice, params_.crowd);
  const PerAction chances = action_chances(values, random_share(trials_.size(), params_.choice));
  Rng draw = rng_.stream(std::to_string(trials_.size()));
  const AttractionAction action = draw_action(chances, draw);
  phase_.emplace(Phase{{now, density, action, style_chances(chances, action.gaze)}, PhaseReward{params_.reward, now}});
  return action;
}

void Attraction::observe(std::span<const Point2> people, Time now) {
  if (phase_) phase_->reward.observe(people, now);
}

std::optional<double> Attraction::finish(Time now) {
  if (!phase_) return std::nullopt;
  const std::optional<double> reward = phase_->reward.finish(now);
  AttractionTrial trial = phase_->trial;
  phase_.reset();
  if (!reward) return std::nullopt;
  trial.reward = params_.ignores_reward ? 0.0 : *reward;
  if (trials_.size() < kMostTrials) {
    evidence_.add(trial);
    trials_.push_back(trial);
  }
  return reward;
}

std::vector<AttractionAction> Attraction::best_known(double density) const {
  const PerAction chances = action_chances(action_values(trials_, density, params_.choice, params_.crowd), 0.0);
  std::vector<AttractionAction> best;
  for (int action = 0; action < kAttractionActions; ++action)
    if (chances.at(static_cast<std::size_t>(action)) > 0.0) best.push_back(attraction_action(action));
  return best;
}

}  // namespace docent::interaction
