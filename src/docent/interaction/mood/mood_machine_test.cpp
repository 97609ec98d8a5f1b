#include "docent/interaction/mood/mood_machine.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace docent::interaction {
namespace {

/// How far a mood is from happy, 0..3.
int anger_of(Mood mood) {
  constexpr std::array kAnger{1, 0, 2, 3};  // neutral, happy, sad, angry
  return kAnger.at(static_cast<std::size_t>(mood));
}

MoodMachine machine(std::uint64_t seed, const MoodParams& params = {}) { return {params, Rng{seed}}; }

/// Steps of `tick` [s] for `time_s`, from `from_s` on.
void live(MoodMachine& mood, bool is_blocked, double from_s, double time_s, double tick = 0.1) {
  const auto steps = static_cast<int>(std::lround(time_s / tick));
  for (int i = 0; i <= steps; ++i) mood.step(is_blocked, time_from_seconds(from_s + i * tick));
}

constexpr std::uint64_t kRobots = 400;

/// [anger] how many of 400 robots are so angry after they were blocked for so long.
std::array<int, 4> robots_after(double blocked_s) {
  std::array<int, 4> robots{};
  for (std::uint64_t seed = 1; seed <= kRobots; ++seed) {
    MoodMachine mood = machine(seed);
    live(mood, true, 0.0, blocked_s);
    ++robots.at(static_cast<std::size_t>(anger_of(mood.mood())));
  }
  return robots;
}

TEST(MoodMachine, TheLongerBlockedTheAngrierInDistribution) {
  std::array<int, 4> before{kRobots, 0, 0, 0};
  for (const double blocked_s : {1.0, 3.0, 6.0, 12.0, 24.0, 60.0}) {
    const auto robots = robots_after(blocked_s);
    int worse_before = 0;
    int worse = 0;
    for (std::size_t anger = 3; anger > 0; --anger) {
      worse_before += before.at(anger);
      worse += robots.at(anger);
      EXPECT_GE(worse, worse_before) << "at least so angry: " << anger << " after " << blocked_s << " s";
    }
    before = robots;
  }
  EXPECT_GT(before.at(3), 380) << "nearly all are angry after a minute";
  EXPECT_GT(robots_after(1.0).at(0), 240) << "a second makes few angry";
}

TEST(MoodMachine, ABlockedRobotNeverGetsHappierAndAFreeOneNeverAngrier) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    MoodMachine mood = machine(seed);
    int before = 0;
    for (int i = 0; i < 600; ++i) {
      const bool is_blocked = i < 300;
      mood.step(is_blocked, time_from_seconds(0.1 * i));
      const int anger = anger_of(mood.mood());
      EXPECT_TRUE(is_blocked ? anger >= before : anger <= before);
      before = anger;
    }
  }
}

TEST(MoodMachine, AFreeWayMakesItHappyAgain) {
  int happy = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    MoodMachine mood = machine(seed);
    live(mood, true, 0.0, 60.0);
    live(mood, false, 60.0, 20.0);
    happy += static_cast<int>(mood.mood() == Mood::happy);
    live(mood, false, 80.0, 100.0);
    EXPECT_EQ(mood.mood(), Mood::happy);
    EXPECT_NEAR(mood.valence(), 1.0, 1e-6);
  }
  EXPECT_GT(happy, 190) << "three moods of 2 s each";
}

TEST(MoodMachine, TheMoodsDoNotDependOnTheTick) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    MoodMachine often = machine(seed);
    MoodMachine seldom = machine(seed);
    for (int phase = 0; phase < 8; ++phase) {
      const bool is_blocked = phase % 2 == 0;
      live(often, is_blocked, 4.0 * phase, 4.0, 0.05);
      live(seldom, is_blocked, 4.0 * phase, 4.0, 4.0);
      EXPECT_EQ(often.mood(), seldom.mood());
      EXPECT_NEAR(often.valence(), seldom.valence(), 1e-9);
    }
  }
}

TEST(MoodMachine, EachMoodLastsItsMeanTime) {
  const MoodParams params;
  double happy_s = 0.0;
  double neutral_s = 0.0;
  constexpr int kRuns = 2000;
  for (int run = 1; run <= kRuns; ++run) {
    MoodMachine mood = machine(static_cast<std::uint64_t>(run));
    for (int i = 0; mood.mood() != Mood::angry && i < 3000; ++i) {
      mood.step(true, time_from_seconds(0.1 * i));
      happy_s += mood.mood() == Mood::happy ? 0.1 : 0.0;
      neutral_s += mood.mood() == Mood::neutral ? 0.1 : 0.0;
    }
  }
  // The standard error of a mean of 2000 exponential times is 2.2 % of it.
  EXPECT_NEAR(happy_s / kRuns, params.to_neutral_s, 0.1 * params.to_neutral_s + 0.1);
  EXPECT_NEAR(neutral_s / kRuns, params.to_sad_s, 0.1 * params.to_sad_s);
}

TEST(MoodMachine, TheValenceGlidesBetweenMoods) {
  MoodMachine mood = machine(11);
  double before = mood.valence();
  EXPECT_EQ(before, 1.0);
  for (int i = 0; i < 2400; ++i) {
    mood.step(i < 1200, time_from_seconds(0.05 * i));
    EXPECT_LE(std::abs(mood.valence() - before), 2.0 * 0.05 / MoodParams{}.glide_s) << "no jumps";
    EXPECT_LE(std::abs(mood.valence()), 1.0);
    before = mood.valence();
    if (i == 1199) {
      EXPECT_EQ(mood.mood(), Mood::angry);
      EXPECT_LT(mood.valence(), -0.95);
    }
  }
  EXPECT_EQ(mood.mood(), Mood::happy);
}

TEST(MoodMachine, AClockThatFallsChangesNothing) {
  MoodMachine mood = machine(4);
  live(mood, true, 100.0, 10.0);
  const Mood before = mood.mood();
  const double valence = mood.valence();
  mood.step(true, time_from_seconds(1.0));
  mood.step(false, time_from_seconds(50.0));
  EXPECT_EQ(mood.mood(), before);
  EXPECT_EQ(mood.valence(), valence);
}

TEST(MoodParams, HaveBounds) {
  EXPECT_TRUE(MoodParams{}.validate());
  for (const MoodParams& bad :
       {MoodParams{0.0}, MoodParams{3.0, -1.0}, MoodParams{3.0, 5.0, 0.0}, MoodParams{3.0, 5.0, 8.0, 0.0},
        MoodParams{3.0, 5.0, 8.0, 2.0, 0.0}, MoodParams{3.0, 5.0, 8.0, 2.0, 0.7, 0.5}})
    EXPECT_FALSE(bad.validate());
}

TEST(MoodMachine, AFaceIsPutOnOverTheMood) {
  MoodMachine machine{{}, Rng{1}};
  machine.put_on(Mood::angry);
  for (int i = 0; i < 50; ++i) machine.step(false, time_from_seconds(0.1 * i));
  EXPECT_EQ(machine.mood(), Mood::angry);
  EXPECT_LT(machine.valence(), -0.9);
  machine.put_on(std::nullopt);
  for (int i = 50; i < 100; ++i) machine.step(false, time_from_seconds(0.1 * i));
  EXPECT_EQ(machine.mood(), Mood::happy);
  EXPECT_GT(machine.valence(), 0.9);
}

}  // namespace
}  // namespace docent::interaction
