#include "docent/apps/laboratory/attract/attract_run.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace docent::apps::attract_command {
namespace {

constexpr std::array kDensities{0.02, 0.08, 0.2};  // [1/m2] quiet, busy, packed (architecture 10.3)
constexpr double kDensitySpread = 0.3;             // [ln] from hour to hour
constexpr double kStep = 0.5;                      // [s]
constexpr double kCounted = 6.0;                   // [m] round the robot, for the density that it sees
constexpr double kSeenError = 0.1;                 // [m] of where it sees people
constexpr double kPhase = 60.0;                    // [s] ([Minerva2000] 6.3)
constexpr double kBetween = 240.0;                 // [s] a tour between two phases

simulator::Shown shown_by(const interaction::AttractionAction& action) {
  return {action.gaze, action.face, action.speech};
}

double liking_of(const AttractRunOptions& options) {
  if (options.taste == CrowdTaste::neither) return 0.0;
  return options.taste == CrowdTaste::friendly ? options.liking : -options.liking;
}

std::vector<Point2> seen(const simulator::PassersBy& people, Rng& rng) {
  std::vector<Point2> result;
  for (const Point2 person : people.people())
    if (norm(person) < kCounted)
      result.push_back(person + Point2{rng.normal(0.0, kSeenError), rng.normal(0.0, kSeenError)});
  return result;
}

double friendliness_of(const interaction::AttractionAction& action) {
  return interaction::friendliness_of(interaction::style_of(action));
}

double friendly_share(const std::vector<interaction::AttractionAction>& actions) {
  const auto friendly =
      std::count_if(actions.begin(), actions.end(), [](const auto& action) { return friendliness_of(action) > 0.0; });
  return static_cast<double>(friendly) / static_cast<double>(actions.size());
}

/// Friendly minus upset, in standard deviations of the crowd that the phase was in.
double difference_of(const std::vector<AttractPhase>& phases, const interaction::CrowdClassParams& crowds) {
  interaction::MomentsByCrowd rewards;
  const auto moments_of = [&](const AttractPhase& phase) -> interaction::RunningMoments& {
    return rewards.at(static_cast<std::size_t>(interaction::crowd_class(phase.trial.density, crowds)));
  };
  for (const AttractPhase& phase : phases) moments_of(phase).add(phase.trial.reward);
  interaction::RunningMoments friendly;
  interaction::RunningMoments upset;
  for (const AttractPhase& phase : phases) {
    const double friendliness = friendliness_of(phase.trial.action);
    const double reward = moments_of(phase).standardised(phase.trial.reward);
    if (friendliness != 0.0) (friendliness > 0.0 ? friendly : upset).add(reward);
  }
  return friendly.count() > 0 && upset.count() > 0 ? friendly.mean() - upset.mean() : 0.0;
}

void summarise(AttractRunOutcome& outcome) {
  const std::size_t last = std::max<std::size_t>(1, outcome.phases.size() / 3);
  for (auto phase = outcome.phases.end() - static_cast<std::ptrdiff_t>(std::min(last, outcome.phases.size()));
       phase != outcome.phases.end(); ++phase) {
    outcome.friendly_at_end += phase->friendly_best / static_cast<double>(last);
    outcome.last_reward += phase->trial.reward / static_cast<double>(last);
  }
}

}  // namespace

AttractRunOutcome run_attract(const AttractRunOptions& options) {
  const Rng rng{options.seed};
  interaction::Attraction learner{options.learner, options.memory, rng.stream("learner")};
  Rng hours = rng.stream("hours");
  Rng sight = rng.stream("sight");
  simulator::PassersByParams crowd;
  crowd.liking = liking_of(options);
  AttractRunOutcome outcome;
  Time now{};
  for (int i = 0; i < options.trials; ++i) {
    const double density =
        kDensities.at(static_cast<std::size_t>(hours.integer(0, 2))) * std::exp(kDensitySpread * hours.normal());
    simulator::PassersBy people{crowd, density, rng.stream("people " + std::to_string(i))};
    const double counted = static_cast<double>(seen(people, sight).size()) / (std::numbers::pi * kCounted * kCounted);
    const double friendly_best = friendly_share(learner.best_known(counted));
    const interaction::AttractionAction action = learner.begin(now, counted);
    people.show(shown_by(action));
    const Time begin = now;
    while (now - begin < seconds(kPhase)) {
      people.step(kStep);
      now = now + seconds(kStep);
      learner.observe(seen(people, sight), now);
    }
    const auto reward = learner.finish(now);
    if (reward) outcome.phases.push_back({{begin, counted, action, {}, *reward}, friendly_best});
    now = now + seconds(kBetween);
  }
  outcome.memory = learner.trials();
  outcome.claim = learner.evidence().claim();
  outcome.claimed_after = learner.evidence().claimed_after();
  outcome.difference = difference_of(outcome.phases, options.learner.crowd);
  summarise(outcome);
  return outcome;
}

}  // namespace docent::apps::attract_command
