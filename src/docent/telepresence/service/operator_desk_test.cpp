#include "docent/telepresence/service/operator_desk.h"

#include <gtest/gtest.h>

#include "docent/messages/conversions.h"
#include "docent/telepresence/service/service_fixture.h"

namespace docent::telepresence {
namespace {

class OperatorDeskTest : public testing::Test {
 protected:
  Reason take(const Caller& caller, const ClientMessage& message) {
    EXPECT_TRUE(desk_.take(caller, message, now_));
    const auto answers = desk_.answers(now_);
    EXPECT_LE(answers.size(), 1U);
    return answers.empty() ? Reason{} : answers[0].why_not;
  }
  /// Two other processes of the robot say what they hold.
  void answer_as_robot() {
    for (const char* keeper : {"avoid", "robot"}) button_.hear(keeper, {button_.state(), true}, now_);
  }
  /// Ten steps a second, as the robot's clock has them.
  void run(double duration) {
    const Time end = now_ + seconds(duration);
    for (; next_step_ <= end; next_step_ = next_step_ + seconds(0.1)) desk_.steer_on(now_ = next_step_);
    now_ = end;
  }
  void steer(const Caller& caller, double duration) {
    for (int i = 0; i < static_cast<int>(duration * 10.0); ++i) {
      EXPECT_EQ(take(caller, SteerMessage{true, 0.5, -0.25}), Reason{});
      run(0.1);
    }
  }

  const Caller ada_{1, Role::staff, "ada"}, grace_{2, Role::staff, "grace"};
  Time now_ = time_from_seconds(100.0);
  Time next_step_ = now_ + seconds(0.1);
  RobotEar robot_;
  std::vector<std::string> notes_;
  StopRegister button_{"web", {}, now_};
  OperatorDesk desk_{robot_,
                     button_,
                     [this](const std::string& who, const std::string& what, const std::string& about) {
                       notes_.push_back(who + " " + what + " " + about);
                     },
                     {{"open", 0.7}, {"web", 0.4}, {"closed", 1.63}}};
};

TEST_F(OperatorDeskTest, NobodySteersWithoutTheLease) {
  EXPECT_EQ(take(ada_, SteerMessage{true, 1.0, 0.0}), Reason{ReasonWord::no_lease});
  run(1.0);
  EXPECT_TRUE(robot_.steered.empty());
  EXPECT_EQ(take(ada_, LeaseMessage{"id", true}), Reason{});
  EXPECT_EQ(take(grace_, LeaseMessage{"id", true}), (Reason{ReasonWord::no_lease, "ada"}));
  EXPECT_EQ(take(grace_, SteerMessage{true, 1.0, 0.0}), (Reason{ReasonWord::no_lease, "ada"}));
  run(0.5);
  ASSERT_FALSE(robot_.steered.empty());
  for (const auto& message : robot_.steered) EXPECT_FALSE(message.is_pressed) << "the lease alone moves nothing";
}

TEST_F(OperatorDeskTest, TheHolderSteersAsLongAsTheyAreHeard) {
  ASSERT_EQ(take(ada_, LeaseMessage{"id", true}), Reason{});
  steer(ada_, 1.0);
  ASSERT_GE(robot_.steered.size(), 9U);
  EXPECT_TRUE(robot_.steered.back().is_pressed);
  EXPECT_EQ(robot_.steered.back().forward, 0.5);
  EXPECT_EQ(robot_.steered.back().by, "ada");
  EXPECT_EQ(desk_.document().holder, "ada");
  run(0.45);
  EXPECT_FALSE(robot_.steered.back().is_pressed) << "silent, it holds nothing";
  EXPECT_EQ(robot_.steered.back().forward, 0.0);
  EXPECT_EQ(desk_.document().holder, "ada");
  run(2.0);
  EXPECT_EQ(desk_.document().holder, "") << "and at last the lease is gone";
  const std::size_t before = robot_.steered.size();
  run(1.0);
  EXPECT_EQ(robot_.steered.size(), before);
  EXPECT_EQ(take(grace_, LeaseMessage{"id", true}), Reason{});
}

TEST_F(OperatorDeskTest, TheLeaseEndsWithItsConnectionOrWhenItIsGivenBack) {
  ASSERT_EQ(take(ada_, LeaseMessage{"id", true}), Reason{});
  desk_.left(grace_, now_);
  EXPECT_EQ(desk_.document().holder, "ada");
  steer(ada_, 0.3);
  desk_.left(ada_, now_);
  run(0.05);
  EXPECT_EQ(desk_.document().holder, "");
  EXPECT_FALSE(robot_.steered.back().is_pressed) << "at once";
  ASSERT_EQ(take(grace_, LeaseMessage{"id", true}), Reason{});
  ASSERT_EQ(take(grace_, LeaseMessage{"id", false}), Reason{});
  EXPECT_EQ(desk_.document().holder, "");
  EXPECT_EQ(notes_, (std::vector<std::string>{"ada lease taken", "ada lease given back", "grace lease taken",
                                              "grace lease given back"}));
}

TEST_F(OperatorDeskTest, AStopNeedsNoLeaseAndIsAnsweredWhenTheRobotHoldsIt) {
  ASSERT_EQ(take(ada_, LeaseMessage{"id", true}), Reason{});
  ASSERT_TRUE(desk_.take(grace_, StopMessage{"stop", true}, now_));
  EXPECT_EQ(robot_.stops, 1) << "told at once";
  EXPECT_TRUE(desk_.document().is_stopped);
  EXPECT_EQ(desk_.document().stopped_by, "grace");
  EXPECT_TRUE(desk_.answers(now_).empty()) << "nobody else holds it";
  answer_as_robot();
  const auto answers = desk_.answers(now_);
  ASSERT_EQ(answers.size(), 1U);
  EXPECT_EQ(answers[0].viewer, grace_.id);
  EXPECT_EQ(answers[0].id, "stop");
  EXPECT_EQ(answers[0].why_not, Reason{});
  EXPECT_TRUE(desk_.answers(now_).empty()) << "once";
  EXPECT_EQ(notes_.back(), "grace stop pressed");
}

TEST_F(OperatorDeskTest, SaysThatTheRobotHasNotConfirmed) {
  ASSERT_TRUE(desk_.take(ada_, StopMessage{"stop", true}, now_));
  run(1.9);
  EXPECT_TRUE(desk_.answers(now_).empty());
  run(0.2);
  const auto answers = desk_.answers(now_);
  ASSERT_EQ(answers.size(), 1U);
  EXPECT_EQ(answers[0].why_not, Reason{ReasonWord::stop_unconfirmed});
  EXPECT_TRUE(desk_.document().is_stopped) << "and goes on to be said";
}

TEST_F(OperatorDeskTest, AReleaseIsForTheStopThatTheOperatorSaw) {
  ASSERT_TRUE(desk_.take(ada_, StopMessage{"stop", true}, now_));
  const int seen = desk_.document().stop_number;
  button_.hear("web/2", {{static_cast<std::uint64_t>(seen) + 1, true, "grace"}, true}, now_);
  EXPECT_EQ(take(ada_, StopMessage{"go", false, seen}), (Reason{ReasonWord::another_stop, "grace"}));
  EXPECT_TRUE(desk_.document().is_stopped);
  ASSERT_TRUE(desk_.take(ada_, StopMessage{"go", false, desk_.document().stop_number}, now_));
  EXPECT_FALSE(desk_.document().is_stopped);
  answer_as_robot();
  for (const auto& answer : desk_.answers(now_)) EXPECT_EQ(answer.why_not, Reason{}) << answer.id;
}

TEST_F(OperatorDeskTest, HoursAreSaidAndTheOtherLimitsStay) {
  docent_msgs::Limits limits;
  limits.max_speed = 0.4;
  desk_.see(limits);
  EXPECT_EQ(take(ada_, SetHoursMessage{"id", OperatingMode::web}), Reason{});
  ASSERT_EQ(robot_.limits.size(), 1U);
  EXPECT_EQ(robot_.limits[0].mode, "web");
  EXPECT_EQ(robot_.limits[0].max_speed, 0.4);
  EXPECT_EQ(desk_.document().hours, "web");
}

TEST_F(OperatorDeskTest, EachModeHasThePaceThatTheMuseumGivesIt) {
  docent_msgs::Limits limits;
  limits.mode = "open";
  limits.max_speed = 0.7;
  desk_.see(limits);
  const auto pace_in = [&](OperatingMode mode) {
    EXPECT_EQ(take(ada_, SetHoursMessage{"id", mode}), Reason{});
    desk_.see(robot_.limits.back());  // it hears what it says
    return robot_.limits.back().max_speed;
  };
  EXPECT_EQ(pace_in(OperatingMode::web), 0.4);
  EXPECT_EQ(pace_in(OperatingMode::closed), 1.63);
  EXPECT_EQ(pace_in(OperatingMode::open), 0.7);
  EXPECT_EQ(pace_in(OperatingMode::hours), 1.63) << "the mode that holds then limits it";
  EXPECT_EQ(pace_in(OperatingMode::web), 0.4);
}

TEST_F(OperatorDeskTest, WhoWantedItSlowerThanItsModeStillDoes) {
  docent_msgs::Limits limits;
  limits.mode = "open";
  limits.max_speed = 0.5;
  desk_.see(limits);
  for (const auto& [mode, pace] : {std::pair{OperatingMode::closed, 0.5}, std::pair{OperatingMode::web, 0.4},
                                   std::pair{OperatingMode::open, 0.5}}) {
    EXPECT_EQ(take(ada_, SetHoursMessage{"id", mode}), Reason{});
    desk_.see(robot_.limits.back());
    EXPECT_EQ(robot_.limits.back().max_speed, pace) << to_text(mode);
  }
}

TEST_F(OperatorDeskTest, LeavesWhatIsNoOperatorsToOthers) { EXPECT_FALSE(desk_.take(ada_, RequestMessage{}, now_)); }

}  // namespace
}  // namespace docent::telepresence
