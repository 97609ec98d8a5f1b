#include "docent/interaction/attract/proximity_reward.h"

#include <gtest/gtest.h>

#include <vector>

namespace docent::interaction {
namespace {

Time at(double time_s) { return time_from_seconds(time_s); }

TEST(ProximityReward, FallsWithTheDistanceAndAddsUpOverPeople) {
  const ProximityRewardParams params;  // worth 1 within 1 m, 0 beyond 2.5 m
  const auto worth = [&](const std::vector<Point2>& people) { return proximity_reward(people, params); };
  EXPECT_DOUBLE_EQ(worth({}), 0.0);
  EXPECT_DOUBLE_EQ(worth({{0.0, 0.9}}), 1.0);
  EXPECT_DOUBLE_EQ(worth({{1.75, 0.0}}), 0.5);
  EXPECT_DOUBLE_EQ(worth({{5.0, 0.0}}), 0.0);
  EXPECT_DOUBLE_EQ(worth({{0.0, -0.9}, {-1.75, 0.0}}), 1.5);
}

TEST(ProximityReward, WhoComesTooCloseCostsMoreThanTheyAreWorth) {
  const ProximityRewardParams params;
  const std::vector<Point2> polite{{0.8, 0.0}};
  const std::vector<Point2> pushy{{0.4, 0.0}};
  const std::vector<Point2> two_pushy{{0.4, 0.0}, {0.0, 0.4}};
  EXPECT_GT(proximity_reward(polite, params), 0.0);
  EXPECT_DOUBLE_EQ(proximity_reward(pushy, params), 1.0 - params.penalty);
  EXPECT_DOUBLE_EQ(proximity_reward(two_pushy, params), 2.0 - params.penalty) << "the penalty is of the moment";
}

TEST(PhaseReward, IsTheMeanOverTimeHoweverOftenPeopleAreSeen) {
  const std::vector<Point2> here{{0.9, 0.0}};
  for (const double period : {0.1, 0.5, 1.0}) {
    PhaseReward reward{{}, at(0.0)};
    for (int i = 1; i * period < 60.001; ++i)
      reward.observe(i * period <= 15.001 ? std::span<const Point2>{here} : std::span<const Point2>{}, at(i * period));
    ASSERT_TRUE(reward.finish(at(60.0)));
    EXPECT_NEAR(*reward.finish(at(60.0)), 0.25, 1e-9) << period;
  }
}

TEST(PhaseReward, APhaseInWhichNobodyLookedTeachesNothing) {
  const std::vector<Point2> here{{0.9, 0.0}};
  PhaseReward blind{{}, at(0.0)};
  EXPECT_FALSE(blind.finish(at(60.0)));
  for (int i = 1; i <= 20; ++i) blind.observe(here, at(i));
  EXPECT_FALSE(blind.finish(at(60.0))) << "20 of 60 seconds";
  for (int i = 21; i <= 31; ++i) blind.observe({}, at(i));
  ASSERT_TRUE(blind.finish(at(60.0)));
  EXPECT_NEAR(*blind.finish(at(60.0)), 20.0 / 31.0, 1e-9) << "of the seconds that were seen";
  EXPECT_FALSE(blind.finish(at(0.0))) << "a phase without length";
}

TEST(PhaseReward, AClockThatFallsIsIgnored) {
  const std::vector<Point2> here{{0.9, 0.0}};
  PhaseReward reward{{}, at(10.0)};
  reward.observe(here, at(5.0));
  reward.observe({}, at(11.0));
  reward.observe(here, at(10.5));
  EXPECT_DOUBLE_EQ(reward.finish(at(11.0)).value_or(-1.0), 0.0);
}

TEST(ProximityReward, ParametersHaveBounds) {
  EXPECT_TRUE(ProximityRewardParams{}.validate());
  const auto refused = [](auto change) {
    ProximityRewardParams params;
    change(params);
    return !params.validate();
  };
  EXPECT_TRUE(refused([](auto& p) { p.near = p.far; }));
  EXPECT_TRUE(refused([](auto& p) { p.too_close = 1.5; }));
  EXPECT_TRUE(refused([](auto& p) { p.penalty = -1.0; }));
  EXPECT_TRUE(refused([](auto& p) { p.least_seen = 1.1; }));
  EXPECT_TRUE(refused([](auto& p) { p.gap_s = 0.0; }));
}

}  // namespace
}  // namespace docent::interaction
