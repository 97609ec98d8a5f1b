#include "docent/task_control/reaction_ladder/reaction_ladder.h"

#include <gtest/gtest.h>

namespace docent::task_control {
namespace {

class ReactionLadderTest : public testing::Test {
 protected:
  /// The robot sees the same for so long, five looks a second; progress goes on only where nothing holds it up.
  void pass(double duration_s) {
    for (const double end = now_s + duration_s - 1e-9; now_s < end;) {
      now_s += 0.2;
      const bool is_free = !view.is_hindered && !view.is_unreachable && !stands;
      view.without_progress_s = is_free ? 0.0 : view.without_progress_s + 0.2;
      for (const LadderStep& step : ladder.step(view, time_from_seconds(now_s))) {
        if (!log.empty()) log += " ";
        log += to_text(step.rung);
        steps.push_back(step);
        times.push_back(now_s);
      }
    }
  }
  [[nodiscard]] double time_of(Rung rung) const {
    for (std::size_t i = 0; i < steps.size(); ++i) {
      if (steps[i].rung == rung) return times[i];
    }
    return -1.0;
  }
  [[nodiscard]] int count(Rung rung) const {
    int result = 0;
    for (const LadderStep& step : steps) result += step.rung == rung ? 1 : 0;
    return result;
  }

  double now_s = 0.0;
  bool stands = false;  ///< no progress, and nothing to see
  LadderView view;
  ReactionLadder ladder{LadderParams{}};
  std::string log;
  std::vector<LadderStep> steps;
  std::vector<double> times;
};

TEST_F(ReactionLadderTest, AFreeWayIsNoNews) {
  pass(60.0);
  EXPECT_EQ(log, "");
}

TEST_F(ReactionLadderTest, WhoStaysInTheWaySeesStepAfterStep) {
  view.is_hindered = view.is_unmapped = true;
  view.cause = "person_in_way";
  pass(6.5);
  EXPECT_EQ(log, "slow horn wait ask");
  EXPECT_NEAR(time_of(Rung::slow), 0.2, 1e-6);
  EXPECT_NEAR(time_of(Rung::horn), 1.8, 0.21);
  EXPECT_NEAR(time_of(Rung::wait), 4.0, 0.21);
  EXPECT_NEAR(time_of(Rung::ask), 6.0, 0.21);
  EXPECT_EQ(steps.front().cause, "person_in_way");
  pass(82.0);
  EXPECT_EQ(count(Rung::horn), 15) << "every six seconds";
  EXPECT_EQ(count(Rung::ask), 6) << "every fifteen seconds";
  EXPECT_EQ(count(Rung::give_up), 0);
  pass(10.0);
  EXPECT_EQ(count(Rung::give_up), 1) << "once, whatever becomes of it";
  EXPECT_EQ(count(Rung::slow), 1);
  EXPECT_EQ(count(Rung::wait), 1);
}

TEST_F(ReactionLadderTest, WhoGoesToAndFroInVainGivesUp) {
  view.is_in_vain = true;
  pass(60.0);
  EXPECT_EQ(log, "give_up") << "once";
}

TEST_F(ReactionLadderTest, NobodySpeaksToAThing) {
  view.is_hindered = view.is_thing = true;
  pass(19.0);
  EXPECT_EQ(log, "slow wait");
  view.is_hindered = view.is_thing = false;  // out of sight for a moment
  stands = true;
  pass(2.0);
  EXPECT_EQ(log, "slow wait give_up") << "a thing does not step aside";
}

TEST_F(ReactionLadderTest, WhatTouchesIsSpokenToNeither) {
  view.is_thing = stands = true;
  pass(15.0);
  EXPECT_EQ(log, "wait");
}

TEST_F(ReactionLadderTest, SomebodyWhoStandsThereThenIsAsked) {
  view.is_hindered = view.is_thing = true;
  pass(10.0);
  view.is_thing = false;
  view.is_unmapped = true;
  pass(2.0);
  EXPECT_EQ(count(Rung::ask), 1);
}

TEST_F(ReactionLadderTest, TheHornNeedsBothSigns) {
  view.is_hindered = true;  // by a wall, or a hazard
  pass(20.0);
  EXPECT_EQ(count(Rung::horn), 0);
  ladder.restart();
  view = {};
  view.is_unmapped = true;  // somebody is there, and it drives on
  pass(20.0);
  EXPECT_EQ(count(Rung::horn), 0);
}

TEST_F(ReactionLadderTest, AFlickerDoesNotHideWhoStandsThere) {
  for (int i = 0; i < 8; ++i) {
    view.is_hindered = view.is_unmapped = i % 3 != 2;
    stands = true;
    pass(0.4);
  }
  EXPECT_EQ(count(Rung::horn), 1);
}

TEST_F(ReactionLadderTest, TellsOfDetoursOnceAndOfTheFreeWay) {
  view.is_hindered = view.is_unmapped = true;
  pass(3.0);
  view.detour = planning::Detour::local;
  pass(1.0);
  view.detour = planning::Detour::global;
  pass(0.4);
  view.is_hindered = view.is_unmapped = false;
  pass(2.8);
  EXPECT_EQ(count(Rung::free), 0);
  pass(1.0);
  EXPECT_EQ(log, "slow horn local_detour wait global_detour free");
  view.detour = planning::Detour::none;
  pass(30.0);
  EXPECT_EQ(count(Rung::free), 1);
}

TEST_F(ReactionLadderTest, AnUnreachablePlaceIsGivenUpSooner) {
  view.is_unreachable = true;
  pass(18.0);
  EXPECT_EQ(count(Rung::give_up), 0);
  pass(3.0);
  EXPECT_EQ(count(Rung::give_up), 1);
  EXPECT_EQ(count(Rung::horn), 0);
}

TEST_F(ReactionLadderTest, AnotherDriveBeginsAtTheFoot) {
  view.is_hindered = view.is_unmapped = true;
  pass(5.0);
  ladder.restart();
  view.without_progress_s = 0.0;
  log.clear();
  pass(2.5);
  EXPECT_EQ(log, "slow horn");
}

TEST_F(ReactionLadderTest, PatienceIsConfigured) {
  LadderParams params;
  params.ask_after_s = 10.0;
  params.patience_s = 30.0;
  ladder = ReactionLadder{params};
  view.is_hindered = true;
  pass(31.0);
  EXPECT_EQ(log, "slow wait ask ask give_up");
  EXPECT_NEAR(time_of(Rung::ask), 10.0, 0.21);
  params.patience_s = 9.0;
  EXPECT_FALSE(params.validate());
}

TEST_F(ReactionLadderTest, CrippledItAsksNobody) {
  LadderParams params;
  params.asks = false;
  ladder = ReactionLadder{params};
  view.is_hindered = view.is_unmapped = true;
  pass(95.0);
  EXPECT_EQ(count(Rung::ask), 0);
  EXPECT_GT(count(Rung::horn), 5);
  EXPECT_EQ(count(Rung::give_up), 1);
}

TEST_F(ReactionLadderTest, SwitchedOffItDoesNothing) {
  LadderParams params;
  params.active = false;
  ladder = ReactionLadder{params};
  view.is_hindered = view.is_unmapped = true;
  pass(200.0);
  EXPECT_EQ(log, "");
}

}  // namespace
}  // namespace docent::task_control
