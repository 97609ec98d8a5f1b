#include "docent/simulator/passers_by/passers_by.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace docent::simulator {
namespace {

constexpr Shown kFriendly{GazeStrategy::nearest, Mood::happy, SpeechAct::invite};
constexpr Shown kUpset{GazeStrategy::nearest, Mood::angry, SpeechAct::complain};

int within(const std::vector<Point2>& people, double reach) {
  int count = 0;
  for (const Point2 person : people) count += static_cast<int>(norm(person) < reach);
  return count;
}

/// Mean number of persons within a reach of the robot, over minutes.
double mean_within(double reach, double liking, double density, const Shown& shown, std::uint64_t minutes = 60) {
  PassersByParams params;
  params.liking = liking;
  double sum = 0.0;
  for (std::uint64_t seed = 1; seed <= minutes; ++seed) {
    PassersBy people{params, density, Rng{seed}};
    people.show(shown);
    for (int i = 0; i < 120; ++i) {
      people.step(0.5);
      sum += within(people.people(), reach);
    }
  }
  return sum / static_cast<double>(minutes) / 120.0;
}

TEST(PassersBy, AsManyWalkByAsTheDensitySaysWhenNobodyStops) {
  PassersByParams params;
  params.stops = 0.0;
  double sum = 0.0;
  constexpr int kMinutes = 100;
  for (int seed = 1; seed <= kMinutes; ++seed) {
    PassersBy people{params, 0.1, Rng{static_cast<std::uint64_t>(seed)}};
    for (int i = 0; i < 120; ++i) people.step(0.5);
    sum += within(people.people(), 5.0);
  }
  EXPECT_NEAR(sum / kMinutes / (std::numbers::pi * 25.0), 0.1, 0.02);
}

TEST(PassersBy, WhomTheyLikeStandsInCompany) {
  EXPECT_GT(mean_within(2.5, 0.8, 0.1, kFriendly), 1.3 * mean_within(2.5, 0.8, 0.1, kUpset));
  EXPECT_LT(mean_within(2.5, -0.8, 0.1, kFriendly), mean_within(2.5, -0.8, 0.1, kUpset) / 1.3);
  EXPECT_EQ(mean_within(2.5, 0.0, 0.1, kFriendly), mean_within(2.5, 0.0, 0.1, kUpset))
      << "whoever does not care draws the same";
}

TEST(PassersBy, WhoIsLookedAtStopsMoreOften) {
  Shown blind = kFriendly;
  blind.gaze = GazeStrategy::ahead;
  EXPECT_GT(mean_within(2.5, 0.5, 0.1, kFriendly, 200), mean_within(2.5, 0.5, 0.1, blind, 200));
}

TEST(PassersBy, TheSameSeedIsTheSameHour) {
  PassersBy one{{}, 0.1, Rng{5}};
  PassersBy other{{}, 0.1, Rng{5}};
  for (int i = 0; i < 100; ++i) {
    one.step(0.5);
    other.step(0.5);
  }
  EXPECT_EQ(one.people(), other.people());
  EXPECT_FALSE(one.people().empty());
}

}  // namespace
}  // namespace docent::simulator
