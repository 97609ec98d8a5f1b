#include "docent/interaction/attract/attraction.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <vector>

namespace docent::interaction {
namespace {

/// What a phase with an action brings.
using World = std::function<double(const AttractionAction&, Rng&)>;

/// One phase of a minute, in which the world puts people so near that the phase is worth a reward of at least 0.
double live(Attraction& attraction, double density, const World& world, Rng& rng, int number) {
  const Time begin = time_from_seconds(100.0 * number);
  const AttractionAction action = attraction.begin(begin, density);
  const double wanted = std::max(0.0, world(action, rng));
  // Whole people at arm's length, and one farther off for the rest.
  std::vector<Point2> people(static_cast<std::size_t>(wanted), Point2{0.9, 0.0});
  people.push_back({2.5 - 1.5 * (wanted - static_cast<double>(people.size())), 0.0});
  for (int i = 1; i <= 60; ++i) attraction.observe(people, begin + seconds(i));
  const auto reward = attraction.finish(begin + seconds(60.0));
  EXPECT_NEAR(reward.value_or(-1.0), wanted, 1e-9);
  return reward.value_or(0.0);
}

double friendliness(const AttractionAction& action) { return friendliness_of(style_of(action)); }

Attraction learner_after(int phases, const World& world, std::uint64_t seed, const AttractionParams& params = {}) {
  Attraction attraction{params, {}, Rng{seed}};
  Rng rng = Rng{seed}.stream("world");
  const std::array<double, 3> densities{0.02, 0.08, 0.2};
  for (int i = 0; i < phases; ++i) live(attraction, densities.at(static_cast<std::size_t>(i % 3)), world, rng, i);
  return attraction;
}

int friendly_of_last(const Attraction& attraction, int count) {
  int friendly = 0;
  for (auto trial = attraction.trials().end() - count; trial != attraction.trials().end(); ++trial)
    friendly += static_cast<int>(friendliness(trial->action) > 0.0);
  return friendly;
}

TEST(Attraction, BecomesFriendlyWhereThatAttractsAndUpsetWhereThatDoes) {
  for (const double sign : {1.0, -1.0}) {
    const World world = [sign](const AttractionAction& action, Rng& rng) {
      return 3.0 + 0.5 * sign * friendliness(action) + 0.4 * rng.normal();
    };
    const Attraction attraction = learner_after(300, world, 7);
    EXPECT_EQ(attraction.evidence().claim(),
              sign > 0.0 ? StyleClaim::friendly_attracts_more : StyleClaim::friendly_attracts_fewer);
    for (const double density : {0.02, 0.08, 0.2})
      EXPECT_GT(sign * friendliness(attraction.best_known(density).front()), 0.0) << density;
    const int friendly = friendly_of_last(attraction, 100);
    EXPECT_TRUE(sign > 0.0 ? friendly > 75 : friendly < 25) << friendly;
  }
}

TEST(Attraction, AGazeThatAttractsIsNoReasonToSpeakOfStyles) {
  const World world = [](const AttractionAction& action, Rng& rng) {
    return (action.gaze == GazeStrategy::nearest ? 4.0 : 2.0) + 0.4 * rng.normal();
  };
  int claims = 0;
  constexpr int kRuns = 60;
  for (std::uint64_t seed = 1; seed <= kRuns; ++seed) {
    const Attraction attraction = learner_after(150, world, seed);
    claims += static_cast<int>(attraction.evidence().claim() != StyleClaim::none);
    EXPECT_EQ(attraction.best_known(0.08).front().gaze, GazeStrategy::nearest) << seed;
  }
  EXPECT_LE(claims, 5) << "at most 5 % of 60 runs, and two more for chance";
}

TEST(Attraction, ARestartInTheMiddleChangesNothing) {
  const World world = [](const AttractionAction& action, Rng& rng) {
    return 2.0 + friendliness(action) + rng.normal();
  };
  Attraction through{{}, {}, Rng{3}};
  Attraction restarted{{}, {}, Rng{3}};
  Rng one{9};
  Rng other{9};
  for (int i = 0; i < 80; ++i) {
    if (i == 41) restarted = Attraction{{}, restarted.trials(), Rng{3}};
    EXPECT_EQ(live(through, 0.08, world, one, i), live(restarted, 0.08, world, other, i));
    EXPECT_EQ(through.trials().back().action, restarted.trials().back().action);
  }
  EXPECT_EQ(through.evidence().log_evidence(StyleClaim::friendly_attracts_more),
            restarted.evidence().log_evidence(StyleClaim::friendly_attracts_more));
}

TEST(Attraction, WhoeverIgnoresTheRewardLearnsNothingAndWhoeverNeverExploresProvesNothing) {
  const World world = [](const AttractionAction& action, Rng& rng) {
    return 3.0 + 0.6 * friendliness(action) + 0.4 * rng.normal();
  };
  AttractionParams deaf;
  deaf.ignores_reward = true;
  const Attraction ignorant = learner_after(200, world, 5, deaf);
  EXPECT_EQ(ignorant.evidence().claim(), StyleClaim::none);
  EXPECT_LT(friendly_of_last(ignorant, 100), 70);
  AttractionParams stubborn;
  stubborn.choice.never_explores = true;
  EXPECT_EQ(learner_after(200, world, 5, stubborn).evidence().claim(), StyleClaim::none);
}

TEST(Attraction, ABeginnerKnowsNothingBetterThanAnythingElse) {
  EXPECT_EQ((Attraction{{}, {}, Rng{1}}.best_known(0.08).size()), static_cast<std::size_t>(kAttractionActions));
}

TEST(Attraction, APhaseThatWasNotSeenOrNeverBeganIsNotRemembered) {
  Attraction attraction{{}, {}, Rng{1}};
  EXPECT_FALSE(attraction.finish(time_from_seconds(1.0)));
  (void)attraction.begin(time_from_seconds(1.0), 0.08);
  EXPECT_TRUE(attraction.is_under_way());
  EXPECT_FALSE(attraction.finish(time_from_seconds(61.0))) << "people was silent";
  EXPECT_TRUE(attraction.trials().empty());
  EXPECT_FALSE(attraction.is_under_way());
}

TEST(AttractionParams, HaveBounds) {
  AttractionParams params;
  EXPECT_TRUE(params.validate());
  params.choice.doubt = 0.0;
  EXPECT_FALSE(params.validate());
}

}  // namespace
}  // namespace docent::interaction
