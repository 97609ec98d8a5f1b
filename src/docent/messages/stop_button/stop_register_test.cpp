#include "docent/messages/stop_button/stop_register.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "docent/base/random.h"

namespace docent {
namespace {

Time at(double t) { return time_from_seconds(t); }

/// Keepers that can die, and a network that repeats, reorders and loses what they say.
class Keepers {
 public:
  explicit Keepers(std::vector<std::string> names) : names_{std::move(names)}, alive_(names_.size()) {
    for (std::size_t i = 0; i < names_.size(); ++i) start(i);
  }
  void start(std::size_t i) { alive_[i] = std::make_unique<StopRegister>(names_[i], StopState{}, now_); }
  void kill(std::size_t i) { alive_[i].reset(); }
  StopRegister& of(std::size_t i) { return *alive_[i]; }
  /// In steps of 0.1 s; `loses`: the share of words that does not arrive.
  void run(double duration, double loses = 0.0) {
    for (const Time end = now_ + seconds(duration); now_ < end;) {
      now_ = now_ + seconds(0.1);
      for (auto& speaker : alive_) {
        const auto word = speaker ? speaker->say(now_) : std::nullopt;
        if (!word) continue;
        for (auto& listener : alive_)
          if (listener && !random_.chance(loses)) listener->hear(speaker->name(), *word, now_);
      }
    }
  }
  [[nodiscard]] Time now() const { return now_; }

 private:
  std::vector<std::string> names_;
  std::vector<std::unique_ptr<StopRegister>> alive_;
  Time now_ = at(1000.0);
  Rng random_{7};
};

TEST(StopState, OfTwoTheLaterHoldsAndOfEqualOnesTheStop) {
  const StopState pressed{3, true, "ada"};
  const StopState released{3, false, "ada"};
  EXPECT_TRUE(overrules({4, false, ""}, pressed));
  EXPECT_FALSE(overrules(pressed, {4, false, ""}));
  EXPECT_TRUE(overrules(pressed, released));
  EXPECT_FALSE(overrules(released, pressed));
  EXPECT_FALSE(overrules(pressed, pressed));
  const StopState other{3, true, "grace"};
  EXPECT_NE(overrules(pressed, other), overrules(other, pressed)) << "all agree on one of them";
}

TEST(StopState, ALineOfAFileHoldsIt) {
  for (const StopState& state : {StopState{}, StopState{12, true, "Ada L."}, StopState{1ULL << 40U, false, ""}}) {
    const auto read = stop_state_of(to_line(state));
    ASSERT_TRUE(read) << to_line(state);
    EXPECT_EQ(*read, state);
  }
  for (const char* damaged :
       {"", "12", "12 ", "stopped ada\n", "12 halted ada\n", "12 stopped ad", "12 stopped", "-1 stopped a\n"})
    EXPECT_FALSE(stop_state_of(damaged)) << damaged;
}

TEST(StopRegister, WhoeverStartsHoldsTheRobotUntilItKnows) {
  StopRegister lone{"avoid", {}, at(10.0)};
  EXPECT_TRUE(lone.holds(at(10.0)));
  EXPECT_TRUE(lone.holds(at(11.9)));
  EXPECT_FALSE(lone.holds(at(12.1))) << "nobody has answered";
  StopRegister second{"avoid", {}, at(10.0)};
  second.hear("web", {{}, false}, at(10.1));
  EXPECT_TRUE(second.holds(at(10.2))) << "that one asks itself";
  second.hear("robot", {{}, true}, at(10.2));
  EXPECT_FALSE(second.holds(at(10.2)));
  StopRegister third{"avoid", {}, at(10.0)};
  third.hear("robot", {{4, true, "ada"}, true}, at(10.1));
  EXPECT_TRUE(third.holds(at(99.0))) << "it is stopped";
}

TEST(StopRegister, AReleaseIsForTheStopThatItNames) {
  StopRegister button{"web", {}, at(0.0)};
  const std::uint64_t first = button.press("ada").number;
  const std::uint64_t second = button.press("grace").number;
  EXPECT_FALSE(button.release("ada", first)) << "somebody has pressed again since";
  EXPECT_TRUE(button.state().is_stopped);
  EXPECT_TRUE(button.release("ada", second));
  EXPECT_FALSE(button.state().is_stopped);
  EXPECT_FALSE(button.release("ada", button.state().number)) << "nothing is stopped";
}

TEST(StopRegister, APressAtOneGatewayBeatsAReleaseAtAnotherAtTheSameTime) {
  Keepers all{{"avoid", "robot", "web/1", "web/2"}};
  all.run(3.0);
  all.of(2).press("ada");
  all.run(0.3);
  all.of(2).press("ada");
  ASSERT_TRUE(all.of(3).release("grace", 1));
  all.run(0.5);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_TRUE(all.of(i).state().is_stopped) << i;
}

TEST(StopRegister, IsConfirmedByThreeLivingKeepers) {
  Keepers all{{"avoid", "robot", "web"}};
  all.run(3.0);
  all.kill(0);
  all.run(1.5);
  const std::uint64_t number = all.of(2).press("ada").number;
  all.run(1.0);
  EXPECT_FALSE(all.of(2).is_confirmed(number, all.now())) << "a dead one holds nothing";
  all.start(0);
  all.run(0.3);
  EXPECT_TRUE(all.of(2).is_confirmed(number, all.now()));
  EXPECT_FALSE(all.of(2).is_confirmed(number + 1, all.now()));
}

TEST(StopRegister, WhatIsConfirmedOutlivesAnyTwoOfThreeTwice) {
  for (const auto& [first, second] : {std::pair{0, 1}, {1, 0}, {0, 2}, {2, 0}, {1, 2}, {2, 1}}) {
    for (const double between : {0.0, 0.1, 0.5, 3.0}) {
      Keepers all{{"avoid", "robot", "web"}};
      all.run(3.0);
      const std::uint64_t number = all.of(2).press("ada").number;
      all.run(0.5, 0.5);
      while (!all.of(2).is_confirmed(number, all.now())) all.run(0.1, 0.5);
      for (int round = 0; round < 2; ++round) {
        all.kill(static_cast<std::size_t>(first));
        all.run(between, 0.3);
        all.kill(static_cast<std::size_t>(second));
        all.start(static_cast<std::size_t>(first));
        all.start(static_cast<std::size_t>(second));
        for (int step = 0; step < 50; ++step) {
          all.run(0.1, 0.3);
          for (std::size_t i = 0; i < 3; ++i)
            EXPECT_TRUE(all.of(i).holds(all.now())) << i << " after " << first << ", " << second << ", " << between;
        }
      }
      ASSERT_TRUE(all.of(0).release("grace", number));
      all.run(2.0, 0.3);
      for (std::size_t i = 0; i < 3; ++i) EXPECT_FALSE(all.of(i).holds(all.now())) << "released everywhere: " << i;
    }
  }
}

TEST(StopRegister, RepeatsAndTellsNewsAtOnce) {
  StopRegister button{"web", {}, at(0.0)};
  EXPECT_TRUE(button.say(at(0.0)));
  EXPECT_FALSE(button.say(at(0.1)));
  EXPECT_TRUE(button.say(at(0.2)));
  button.press("ada");
  const auto word = button.say(at(0.21));
  ASSERT_TRUE(word);
  EXPECT_TRUE(word->state.is_stopped);
  EXPECT_FALSE(word->is_sure);
  EXPECT_TRUE(button.say(at(2.2))->is_sure);
}

}  // namespace
}  // namespace docent
