#include "docent/apps/laboratory/attract/attract_run.h"

#include <gtest/gtest.h>

namespace docent::apps::attract_command {
namespace {

AttractRunOutcome outcome_of(CrowdTaste taste, std::uint64_t seed, int trials = 201) {
  AttractRunOptions options;
  options.seed = seed;
  options.taste = taste;
  options.trials = trials;
  return run_attract(options);
}

TEST(AttractRun, FindsWhatTheCrowdLikesInMostRuns) {
  int friendly = 0;
  int upset = 0;
  int wrong = 0;
  for (std::uint64_t seed = 101; seed <= 105; ++seed) {
    const auto likes_friendly = outcome_of(CrowdTaste::friendly, seed);
    const auto likes_upset = outcome_of(CrowdTaste::upset, seed);
    friendly += static_cast<int>(likes_friendly.claim == interaction::StyleClaim::friendly_attracts_more);
    upset += static_cast<int>(likes_upset.claim == interaction::StyleClaim::friendly_attracts_fewer);
    wrong += static_cast<int>(likes_friendly.claim == interaction::StyleClaim::friendly_attracts_fewer) +
             static_cast<int>(likes_upset.claim == interaction::StyleClaim::friendly_attracts_more);
    EXPECT_GT(likes_friendly.friendly_at_end, likes_upset.friendly_at_end);
    EXPECT_GT(likes_friendly.difference, 0.3);
    EXPECT_LT(likes_upset.difference, -0.3);
  }
  EXPECT_GE(friendly, 4);
  EXPECT_GE(upset, 4);
  EXPECT_EQ(wrong, 0);
}

TEST(AttractRun, TheSameSeedIsTheSameRunAndARestartGoesOn) {
  const auto once = outcome_of(CrowdTaste::friendly, 3, 30);
  const auto again = outcome_of(CrowdTaste::friendly, 3, 30);
  ASSERT_EQ(once.memory.size(), 30U);
  for (std::size_t i = 0; i < once.memory.size(); ++i) {
    EXPECT_EQ(once.memory[i].action, again.memory[i].action);
    EXPECT_EQ(once.memory[i].reward, again.memory[i].reward);
  }
  AttractRunOptions later;
  later.seed = 4;
  later.trials = 10;
  later.memory = once.memory;
  const auto outcome = run_attract(later);
  EXPECT_EQ(outcome.memory.size(), 40U);
  EXPECT_EQ(outcome.phases.size(), 10U);
}

TEST(AttractRun, ARobotThatIgnoresTheRewardIsNeverFriendlierThanChance) {
  AttractRunOptions options;
  options.seed = 1;
  options.learner.ignores_reward = true;
  const auto outcome = run_attract(options);
  EXPECT_EQ(outcome.claim, interaction::StyleClaim::none);
  EXPECT_NEAR(outcome.friendly_at_end, 0.25, 1e-9) << "5 of 20 faces and words are friendly, and all are equally good";
}

}  // namespace
}  // namespace docent::apps::attract_command
