#include "docent/interaction/attract/style_evidence.h"

#include <gtest/gtest.h>

#include <cmath>

#include "docent/base/random.h"

namespace docent::interaction {
namespace {

const AttractionAction kFriendly{GazeStrategy::nearest, Mood::happy, SpeechAct::invite};
const AttractionAction kUpset{GazeStrategy::nearest, Mood::angry, SpeechAct::demand};

/// A trial in which a friendly style was drawn with a probability, and else an upset one.
AttractionTrial trial_of(bool is_friendly, double chance_of_friendly, double reward, double density = 0.08) {
  return {Time{},
          density,
          is_friendly ? kFriendly : kUpset,
          {chance_of_friendly, 0.0, 0.0, 0.0, 1.0 - chance_of_friendly},
          reward};
}

struct Told {
  StyleClaim claim = StyleClaim::none;
  int after = 0;
};

/// Trials by a policy that follows the rewards: the style that did better so far has a chance of 0.9.
/// @param gain  what a friendly style adds to a reward of standard deviation 1
Told told_after(int trials, double gain, Rng& rng) {
  StyleEvidence evidence{{}, {}};
  RunningMoments friendly;
  RunningMoments upset;
  for (int i = 0; i < trials; ++i) {
    const double chance = i < 10 ? 0.5 : friendly.mean() > upset.mean() ? 0.9 : 0.1;
    const bool is_friendly = rng.chance(chance);
    const double reward = rng.normal() + (is_friendly ? gain : 0.0);
    (is_friendly ? friendly : upset).add(reward);
    evidence.add(trial_of(is_friendly, chance, reward));
  }
  return {evidence.claim(), evidence.claimed_after()};
}

TEST(StyleEvidence, APolicyThatFollowsTheRewardsMakesNoFalseClaims) {
  constexpr int kRuns = 1000;
  int claims = 0;
  Rng rng{1};
  for (int run = 0; run < kRuns; ++run) claims += static_cast<int>(told_after(400, 0.0, rng).claim != StyleClaim::none);
  EXPECT_LE(claims, 50) << "at most 5 % ever, looked at after each of 400 trials";
}

TEST(StyleEvidence, ALargeDifferenceIsFoundOnTheRightSide) {
  constexpr int kRuns = 100;
  Rng rng{2};
  int more = 0;
  int fewer = 0;
  for (int run = 0; run < kRuns; ++run) {
    more += static_cast<int>(told_after(300, 1.2, rng).claim == StyleClaim::friendly_attracts_more);
    fewer += static_cast<int>(told_after(300, -1.2, rng).claim == StyleClaim::friendly_attracts_fewer);
  }
  EXPECT_GE(more, 90);
  EXPECT_GE(fewer, 90);
}

TEST(StyleEvidence, TheFactorOfATrialHasExpectationOneHoweverItWasDrawn) {
  // Two trials of the same past: the styles that could be drawn, weighed by their chances.
  const auto product = [](bool is_friendly, double chance, double reward) {
    StyleEvidence evidence{{0.05, 2, 2.5, {0.4}}, {}};
    for (const double past : {0.0, 1.0, 2.0}) evidence.add(trial_of(true, 1.0, past));
    EXPECT_NEAR(evidence.log_evidence(StyleClaim::friendly_attracts_more), 0.0, 1e-12)
        << "what is certain proves nothing";
    evidence.add(trial_of(is_friendly, chance, reward));
    return std::exp(evidence.log_evidence(StyleClaim::friendly_attracts_more));
  };
  for (const double chance : {0.05, 0.5, 0.9})
    for (const double reward : {-3.0, 0.5, 1.0, 7.0})
      EXPECT_NEAR(chance * product(true, chance, reward) + (1.0 - chance) * product(false, chance, reward), 1.0, 1e-12);
  EXPECT_GT(product(true, 0.5, 2.0), 1.0);
  EXPECT_LT(product(false, 0.5, 2.0), 1.0);
  EXPECT_GT(product(true, 0.05, 2.0), product(true, 0.9, 2.0)) << "what was drawn against the odds says more";
}

TEST(StyleEvidence, AClaimStaysAndKnowsWhenItWasMade) {
  StyleEvidence evidence{{}, {}};
  Rng rng{3};
  const auto add_some = [&](int count, double gain) {
    for (int i = 0; i < count; ++i) {
      const bool is_friendly = rng.chance(0.5);
      evidence.add(trial_of(is_friendly, 0.5, rng.normal() + (is_friendly ? gain : 0.0)));
    }
  };
  EXPECT_EQ(evidence.claimed_after(), 0);
  add_some(100, 2.0);
  EXPECT_EQ(evidence.claim(), StyleClaim::friendly_attracts_more);
  const int after = evidence.claimed_after();
  EXPECT_GT(after, 6);
  EXPECT_LE(after, 100);
  EXPECT_GE(evidence.log_evidence(StyleClaim::friendly_attracts_more), std::log(40.0));
  add_some(10, 0.0);
  EXPECT_EQ(evidence.claim(), StyleClaim::friendly_attracts_more);
  EXPECT_EQ(evidence.claimed_after(), after);
}

TEST(StyleEvidence, ARewardIsComparedWithThoseOfItsOwnCrowd) {
  // Upset only in packed halls, where each phase is worth more: the crowd, not the style.
  StyleEvidence evidence{{}, {}};
  Rng rng{4};
  for (int i = 0; i < 300; ++i) {
    const bool is_packed = i % 2 == 0;
    const double chance = is_packed ? 0.2 : 0.8;
    const bool is_friendly = rng.chance(chance);
    evidence.add(trial_of(is_friendly, chance, rng.normal() + (is_packed ? 10.0 : 0.0), is_packed ? 0.2 : 0.02));
  }
  EXPECT_EQ(evidence.claim(), StyleClaim::none);
}

TEST(StyleEvidence, ParametersHaveBounds) {
  EXPECT_TRUE(StyleEvidenceParams{}.validate());
  for (const StyleEvidenceParams& bad :
       {StyleEvidenceParams{0.0}, StyleEvidenceParams{0.05, 1}, StyleEvidenceParams{0.05, 6, 0.0},
        StyleEvidenceParams{0.05, 6, 2.5, {}}, StyleEvidenceParams{0.05, 6, 2.5, {0.2, -0.2}}})
    EXPECT_FALSE(bad.validate());
}

}  // namespace
}  // namespace docent::interaction
