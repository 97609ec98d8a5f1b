#include "docent/interaction/attract/action_values.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace docent::interaction {
namespace {

const AttractionAction kWarm{GazeStrategy::nearest, Mood::happy, SpeechAct::invite};
const AttractionAction kCold{GazeStrategy::ahead, Mood::angry, SpeechAct::complain};

AttractionTrial trial_of(const AttractionAction& action, double reward, double density) {
  return {Time{}, density, action, {0.2, 0.2, 0.2, 0.2, 0.2}, reward};
}
double value_of(const PerAction& values, const AttractionAction& action) {
  return values.at(static_cast<std::size_t>(index_of(action)));
}
PerAction values_of(const TrialMemory& trials, double density) { return action_values(trials, density, {}, {}); }

TEST(ActionValues, WithoutTrialsAllAreAlike) {
  const PerAction values = values_of({}, 0.08);
  for (const double value : values) EXPECT_EQ(value, 0.0);
  const PerAction chances = action_chances(values, 0.0);
  for (const double chance : chances) EXPECT_DOUBLE_EQ(chance, 1.0 / kAttractionActions);
}

TEST(ActionValues, WhatWasRewardedIsBestAndItsKinAreBetterThanStrangers) {
  const PerAction values = values_of({trial_of(kWarm, 3.0, 0.08), trial_of(kCold, 1.0, 0.08)}, 0.08);
  EXPECT_EQ(std::max_element(values.begin(), values.end()) - values.begin(), index_of(kWarm));
  EXPECT_EQ(std::min_element(values.begin(), values.end()) - values.begin(), index_of(kCold));
  const AttractionAction sister{GazeStrategy::nearest, Mood::happy, SpeechAct::ask};
  EXPECT_GT(value_of(values, kWarm), value_of(values, sister));
  EXPECT_GT(value_of(values, sister), value_of(values, {GazeStrategy::everybody, Mood::neutral, SpeechAct::silence}));
}

TEST(ActionValues, WhatIsBestDependsOnTheDensity) {
  TrialMemory trials;
  for (int i = 0; i < 10; ++i) {
    trials.push_back(trial_of(kWarm, 2.0, 0.02));
    trials.push_back(trial_of(kCold, 1.0, 0.02));
    trials.push_back(trial_of(kWarm, 1.0, 0.2));
    trials.push_back(trial_of(kCold, 2.0, 0.2));
  }
  const PerAction quiet = values_of(trials, 0.02);
  const PerAction packed = values_of(trials, 0.2);
  EXPECT_GT(value_of(quiet, kWarm), value_of(quiet, kCold));
  EXPECT_LT(value_of(packed, kWarm), value_of(packed, kCold));
}

TEST(ActionValues, ACrowdThatIsWorthMoreMakesNoActionBetter) {
  // The warm action was done in packed halls alone, where everything is worth more.
  TrialMemory trials;
  for (int i = 0; i < 10; ++i) {
    trials.push_back(trial_of(kWarm, i % 2 == 0 ? 9.0 : 11.0, 0.2));
    trials.push_back(trial_of(kCold, i % 2 == 0 ? 1.0 : 3.0, 0.02));
  }
  const PerAction values = values_of(trials, 0.08);
  EXPECT_NEAR(value_of(values, kWarm), value_of(values, kCold), 1e-9);
}

TEST(ActionValues, OneLuckyTrialDoesNotOutweighManyGoodOnes) {
  TrialMemory trials{trial_of(kCold, 2.2, 0.08)};
  for (int i = 0; i < 20; ++i) trials.push_back(trial_of(kWarm, 2.0, 0.08));
  for (int i = 0; i < 20; ++i)
    trials.push_back(trial_of({GazeStrategy::everybody, Mood::sad, SpeechAct::silence}, 0.0, 0.08));
  const PerAction values = values_of(trials, 0.08);
  EXPECT_GT(value_of(values, kWarm), value_of(values, kCold));
}

TEST(ActionChances, SumToOneAndTheBestHasNearlyAll) {
  for (const double share : {0.0, 0.1, 1.0}) {
    const PerAction values = values_of({trial_of(kWarm, 3.0, 0.08), trial_of(kCold, 1.0, 0.08)}, 0.08);
    const PerAction chances = action_chances(values, share);
    EXPECT_NEAR(std::accumulate(chances.begin(), chances.end(), 0.0), 1.0, 1e-12);
    EXPECT_NEAR(value_of(chances, kWarm), 1.0 - share + share / kAttractionActions, 1e-12);
    EXPECT_NEAR(value_of(chances, kCold), share / kAttractionActions, 1e-12);
    const StyleChances styles = style_chances(chances, GazeStrategy::nearest);
    EXPECT_NEAR(std::accumulate(styles.begin(), styles.end(), 0.0), 1.0, 1e-12);
    EXPECT_GE(styles.front() + 1e-12, 1.0 - share) << "the best one is friendly";
    if (share <= 0.0) continue;
    const StyleChances elsewhere = style_chances(chances, GazeStrategy::ahead);
    EXPECT_NEAR(elsewhere.front(), 2.0 / 20.0, 1e-12) << "with another gaze all is random: 2 of its 20 are friendly";
  }
}

TEST(ActionChances, RandomActionsBecomeFewAndNeverEnd) {
  const ActionChoiceParams params;
  EXPECT_DOUBLE_EQ(random_share(0, params), 1.0);
  EXPECT_DOUBLE_EQ(random_share(60, params), 0.5);
  EXPECT_DOUBLE_EQ(random_share(100000, params), params.explore);
  ActionChoiceParams crippled;
  crippled.never_explores = true;
  EXPECT_DOUBLE_EQ(random_share(0, crippled), 0.0);
}

TEST(DrawAction, DrawsAsOftenAsTheChancesSay) {
  PerAction chances{};
  chances.at(3) = 0.25;
  chances.at(40) = 0.75;
  Rng rng{5};
  int first = 0;
  constexpr int kDraws = 4000;
  for (int i = 0; i < kDraws; ++i) {
    const int drawn = index_of(draw_action(chances, rng));
    ASSERT_TRUE(drawn == 3 || drawn == 40);
    first += static_cast<int>(drawn == 3);
  }
  EXPECT_NEAR(static_cast<double>(first) / kDraws, 0.25, 0.03);
}

TEST(ActionChoiceParams, HaveBounds) {
  EXPECT_TRUE(ActionChoiceParams{}.validate());
  for (const ActionChoiceParams& bad :
       {ActionChoiceParams{-0.1}, ActionChoiceParams{0.1, -1.0}, ActionChoiceParams{0.1, 60.0, 1.5},
        ActionChoiceParams{0.1, 60.0, 0.3, 0.0}, ActionChoiceParams{0.1, 60.0, 0.3, 0.7, 0.0}})
    EXPECT_FALSE(bad.validate());
}

}  // namespace
}  // namespace docent::interaction
