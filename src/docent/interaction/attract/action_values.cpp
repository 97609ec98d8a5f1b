#include "docent/interaction/attract/action_values.h"

#include <algorithm>
#include <cmath>

#include "docent/base/check.h"

namespace docent::interaction {
namespace {

constexpr double kLeastDensity = 0.005;  // [1/m2] emptier halls are all alike
constexpr double kTie = 1e-12;           // values that are nearer than this are equal

std::size_t class_of(const AttractionTrial& trial, const CrowdClassParams& crowds) {
  return static_cast<std::size_t>(crowd_class(trial.density, crowds));
}
double log_density(double density) { return std::log(std::max(density, kLeastDensity)); }

}  // namespace

Result<void> ActionChoiceParams::validate() const {
  if (!(explore >= 0.0 && explore <= 1.0)) return fail("choice.explore must be 0..1");
  if (!(learning >= 0.0)) return fail("choice.learning must be >= 0");
  if (!(kinship >= 0.0 && kinship <= 1.0)) return fail("choice.kinship must be 0..1");
  if (!(density_width > 0.0)) return fail("choice.density_width must be > 0");
  if (!(doubt > 0.0)) return fail("choice.doubt must be > 0");
  return {};
}

PerAction action_values(const TrialMemory& trials, double density, const ActionChoiceParams& params,
                        const CrowdClassParams& crowds) {
  MomentsByCrowd rewards;
  for (const AttractionTrial& trial : trials) rewards.at(class_of(trial, crowds)).add(trial.reward);
  PerAction weights{};
  PerAction sums{};
  for (const AttractionTrial& trial : trials) {
    const double apart = (log_density(trial.density) - log_density(density)) / params.density_width;
    const double weight = std::exp(-0.5 * apart * apart);
    const auto action = static_cast<std::size_t>(index_of(trial.action));
    weights.at(action) += weight;
    sums.at(action) += weight * rewards.at(class_of(trial, crowds)).standardised(trial.reward);
  }
  std::array<double, 4> kinship{1.0};
  for (std::size_t i = 1; i < kinship.size(); ++i) kinship.at(i) = params.kinship * kinship.at(i - 1);
  PerAction values{};
  for (int action = 0; action < kAttractionActions; ++action) {
    double weight = params.doubt;
    double sum = 0.0;
    for (int other = 0; other < kAttractionActions; ++other) {
      const auto apart = static_cast<std::size_t>(differences(attraction_action(action), attraction_action(other)));
      weight += kinship.at(apart) * weights.at(static_cast<std::size_t>(other));
      sum += kinship.at(apart) * sums.at(static_cast<std::size_t>(other));
    }
    values.at(static_cast<std::size_t>(action)) = sum / weight;
  }
  return values;
}

double random_share(std::size_t trials, const ActionChoiceParams& params) {
  if (params.never_explores) return 0.0;
  if (params.learning <= 0.0) return params.explore;
  return std::max(params.explore, params.learning / (params.learning + static_cast<double>(trials)));
}

PerAction action_chances(const PerAction& values, double random_share) {
  const double best = *std::max_element(values.begin(), values.end()) - kTie;
  const auto is_best = [best](double value) { return value >= best; };
  const auto ties = static_cast<double>(std::count_if(values.begin(), values.end(), is_best));
  PerAction chances{};
  std::transform(values.begin(), values.end(), chances.begin(), [&](double value) {
    return random_share / kAttractionActions + (is_best(value) ? (1.0 - random_share) / ties : 0.0);
  });
  return chances;
}

StyleChances style_chances(const PerAction& chances, GazeStrategy gaze) {
  StyleChances result{};
  double sum = 0.0;
  for (int i = 0; i < kAttractionActions; ++i) {
    const AttractionAction action = attraction_action(i);
    if (action.gaze != gaze) continue;
    const double chance = chances.at(static_cast<std::size_t>(i));
    result.at(static_cast<std::size_t>(style_of(action))) += chance;
    sum += chance;
  }
  DOCENT_CHECK(sum > 0.0);
  for (double& chance : result) chance /= sum;
  return result;
}

AttractionAction draw_action(const PerAction& chances, Rng& rng) {
  double left = rng.uniform();
  int drawn = 0;
  for (int action = 0; action < kAttractionActions; ++action) {
    const double chance = chances.at(static_cast<std::size_t>(action));
    if (chance <= 0.0) continue;
    drawn = action;  // the last one with a chance takes what rounding leaves
    left -= chance;
    if (left < 0.0) break;
  }
  return attraction_action(drawn);
}

}  // namespace docent::interaction
