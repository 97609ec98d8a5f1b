#include "docent/task_control/navigation_goals/navigation_goals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace docent::task_control {
namespace {

Time at(double value) { return time_from_seconds(100.0 + value); }

constexpr GoalId kFirst{1};
constexpr GoalId kSecond{2};

/// A robot that keeps a board, as the mission does; what it is told may be lost.
class Navigation : public testing::Test {
 protected:
  void begin(const GoalId& id, std::vector<Pose2> poses, double t) {
    NavigationGoal goal{id, std::move(poses)};
    ASSERT_EQ(goals.refusal(goal), "");
    goals.begin(std::move(goal), at(t));
    take(t);
  }
  /// Hears what there is to do. The robot gets it unless it is `deaf`.
  void take(double t) {
    auto actions = goals.take_actions();
    for (const GoalEnd& end : actions.ends) ends.push_back(end);
    for (const StaffRequest& request : actions.requests) {
      sent.push_back(request);
      if (deaf) continue;
      const auto known = std::find_if(shown.begin(), shown.end(), [&](const auto& n) { return n.id == request.id; });
      if (known != shown.end()) continue;
      if (request.kind == RequestKind::cancel) {
        const bool is_known = change(request.target, RequestStatus::cancelled, "cancelled");
        shown.push_back({request.id, is_known ? RequestStatus::fulfilled : RequestStatus::refused, ""});
      } else {
        shown.push_back({request.id, RequestStatus::queued, ""});
      }
    }
    if (deaf) return;
    goals.board(shown, at(t));
    auto more = goals.take_actions();
    for (const GoalEnd& end : more.ends) ends.push_back(end);
    for (const StaffRequest& request : more.requests) {
      sent.push_back(request);
      shown.push_back({request.id, RequestStatus::queued, ""});
    }
    if (!more.requests.empty()) goals.board(shown, at(t));
  }
  bool change(const std::string& id, RequestStatus status, const std::string& reason = {}) {
    for (RequestNews& news : shown) {
      if (news.id != id || !docent::is_open(news.status)) continue;
      news.status = status;
      news.reason = reason;
      return true;
    }
    return false;
  }
  void set(RequestStatus status, double t, const std::string& reason = {}) {
    ASSERT_TRUE(change(last_point().id, status, reason));
    take(t);
  }
  [[nodiscard]] const StaffRequest& last_point() const {
    const auto place =
        std::find_if(sent.rbegin(), sent.rend(), [](const auto& r) { return r.kind == RequestKind::point; });
    return *place;
  }
  void pass(double from, double to) {
    for (double t = from; t <= to + 1e-9; t += 0.1) {
      if (speaks) goals.drive(remaining_m, false, at(t));
      goals.tick(at(t));
      take(t);
    }
  }

  NavigationGoals goals{NavigationGoalParams{}};
  std::vector<StaffRequest> sent;
  std::vector<GoalEnd> ends;
  std::vector<RequestNews> shown;
  bool deaf = false;
  bool speaks = true;
  double remaining_m = 3.0;
};

TEST_F(Navigation, AGoalIsOneRequestAndEndsWithIt) {
  begin(kFirst, {{1.0, 2.0, Angle::radians(0.5)}}, 0);
  ASSERT_EQ(sent.size(), 1U);
  EXPECT_EQ(sent[0].target, "1.00,2.00,0.500");
  set(RequestStatus::active, 1);
  pass(1, 8);
  EXPECT_EQ(sent.size(), 1U) << "what stands on the board is not sent again";
  EXPECT_TRUE(ends.empty());
  set(RequestStatus::fulfilled, 9);
  ASSERT_EQ(ends.size(), 1U);
  EXPECT_EQ(ends[0].id, kFirst);
  EXPECT_EQ(ends[0].outcome, GoalOutcome::succeeded);
  EXPECT_FALSE(goals.progress(at(9)));
}

TEST_F(Navigation, TheHeadingOfPosesOnTheWayDoesNotMatter) {
  begin(kFirst, {{1.0, 0.0, Angle::degrees(90.0)}, {2.0, 0.0, Angle::degrees(180.0)}}, 0);
  EXPECT_EQ(sent[0].target, "1.00,0.00");
  EXPECT_EQ(goals.progress(at(0))->poses_remaining, 2);
  set(RequestStatus::fulfilled, 3);
  ASSERT_EQ(sent.size(), 2U);
  EXPECT_EQ(sent[1].target, "2.00,0.00,-3.142");
  EXPECT_NE(sent[0].id, sent[1].id);
  EXPECT_EQ(goals.progress(at(3))->poses_remaining, 1);
  EXPECT_TRUE(ends.empty());
  set(RequestStatus::fulfilled, 6);
  EXPECT_EQ(ends.at(0).outcome, GoalOutcome::succeeded);
}

TEST_F(Navigation, ANewerGoalReplacesTheOneUnderWay) {
  begin(kFirst, {{1.0, 0.0, {}}}, 0);
  set(RequestStatus::active, 1);
  begin(kSecond, {{5.0, 0.0, {}}}, 2);
  ASSERT_EQ(ends.size(), 1U);
  EXPECT_EQ(ends[0].id, kFirst);
  EXPECT_EQ(ends[0].outcome, GoalOutcome::aborted);
  EXPECT_EQ(ends[0].reason, "replaced");
  ASSERT_EQ(sent.size(), 3U);
  EXPECT_EQ(sent[1].kind, RequestKind::cancel);
  EXPECT_EQ(sent[1].target, sent[0].id);
  EXPECT_EQ(sent[2].target, "5.00,0.00,0.000");
  set(RequestStatus::fulfilled, 4);
  ASSERT_EQ(ends.size(), 2U);
  EXPECT_EQ(ends[1].id, kSecond);
  EXPECT_EQ(ends[1].outcome, GoalOutcome::succeeded);
}

TEST_F(Navigation, WhatIsReplacedIsWithdrawnUntilTheRobotHasHeard) {
  begin(kFirst, {{1.0, 0.0, {}}}, 0);
  set(RequestStatus::active, 0.5);
  deaf = true;
  begin(kSecond, {{5.0, 0.0, {}}}, 1);
  pass(1, 3.5);
  deaf = false;
  pass(3.6, 4.2);
  EXPECT_EQ(shown[0].status, RequestStatus::cancelled);
  const auto count = sent.size();
  pass(4.3, 8);
  EXPECT_EQ(sent.size(), count) << "once the robot has heard, nothing is sent again";
  EXPECT_EQ(ends.size(), 1U);
}

TEST_F(Navigation, CanceledIsSaidWhenTheRobotSaysSo) {
  begin(kFirst, {{1.0, 0.0, {}}}, 0);
  set(RequestStatus::active, 1);
  deaf = true;
  goals.cancel(kFirst, at(2));
  take(2);
  EXPECT_EQ(sent.back().kind, RequestKind::cancel);
  EXPECT_TRUE(ends.empty()) << "nobody has said yet that it stands";
  deaf = false;
  pass(2.1, 3.2);
  ASSERT_EQ(ends.size(), 1U);
  EXPECT_EQ(ends[0].outcome, GoalOutcome::canceled);
}

TEST_F(Navigation, AGoalThatIsNotUnderWayCannotBeCanceled) {
  begin(kFirst, {{1.0, 0.0, {}}}, 0);
  goals.cancel(kSecond, at(1));
  take(1);
  EXPECT_EQ(sent.size(), 1U);
}

TEST_F(Navigation, WhoArrivesWhileItIsCanceledHasSucceeded) {
  begin(kFirst, {{1.0, 0.0, {}}}, 0);
  set(RequestStatus::active, 1);
  deaf = true;
  goals.cancel(kFirst, at(2));
  take(2);
  change(last_point().id, RequestStatus::fulfilled);
  deaf = false;
  take(2.1);
  ASSERT_EQ(ends.size(), 1U);
  EXPECT_EQ(ends[0].outcome, GoalOutcome::succeeded);
}

TEST_F(Navigation, ARefusalAndAFailureAbortWithTheirReason) {
  begin(kFirst, {{1.0, 0.0, {}}}, 0);
  set(RequestStatus::refused, 1, "not_on_free_floor");
  EXPECT_EQ(ends.at(0).outcome, GoalOutcome::aborted);
  EXPECT_EQ(ends.at(0).reason, "not_on_free_floor");
  begin(kSecond, {{2.0, 0.0, {}}}, 2);
  set(RequestStatus::failed, 3, "way_blocked");
  EXPECT_EQ(ends.at(1).reason, "way_blocked");
}

TEST_F(Navigation, WhoeverElseCancelsItAbortsIt) {
  begin(kFirst, {{1.0, 0.0, {}}}, 0);
  set(RequestStatus::cancelled, 1, "cancelled");
  EXPECT_EQ(ends.at(0).outcome, GoalOutcome::aborted);
  EXPECT_EQ(ends.at(0).reason, "cancelled");
}

TEST_F(Navigation, ARobotThatDoesNotHearIsToldAgainAndThenGivenUp) {
  deaf = true;
  begin(kFirst, {{1.0, 0.0, {}}}, 0);
  pass(0.1, 4.8);
  EXPECT_EQ(sent.size(), 5U) << "once a second";
  for (const StaffRequest& request : sent) EXPECT_EQ(request.id, sent[0].id);
  EXPECT_TRUE(ends.empty());
  pass(4.9, 5.1);
  ASSERT_EQ(ends.size(), 1U);
  EXPECT_EQ(ends[0].outcome, GoalOutcome::aborted);
  EXPECT_EQ(ends[0].reason, "robot_silent");
  EXPECT_EQ(sent.back().kind, RequestKind::cancel) << "it may come later, and nobody wants it then";
}

TEST_F(Navigation, ARobotThatFallsSilentOnTheWayIsGivenUp) {
  begin(kFirst, {{1.0, 0.0, {}}}, 0);
  set(RequestStatus::active, 1);
  pass(1, 2);
  speaks = false;
  pass(2.1, 21.8);
  EXPECT_TRUE(ends.empty());
  pass(21.9, 22.2);
  ASSERT_EQ(ends.size(), 1U);
  EXPECT_EQ(ends[0].reason, "robot_silent");
}

TEST_F(Navigation, ARobotThatHasForgottenItIsToldAgain) {
  begin(kFirst, {{1.0, 0.0, {}}}, 0);
  set(RequestStatus::active, 1);
  shown.clear();  // its store is gone
  take(9);
  pass(9.1, 10.3);
  EXPECT_EQ(sent.size(), 2U);
  EXPECT_EQ(sent[1].id, sent[0].id);
  EXPECT_TRUE(ends.empty());
}

TEST_F(Navigation, TellsWayAndTime) {
  goals.pose({0.0, 0.0, {}});
  begin(kFirst, {{4.0, 0.0, {}}, {4.0, 3.0, {}}}, 0);
  // While it waits, as the crow flies: 4 m and 3 m at 0.5 m/s.
  EXPECT_DOUBLE_EQ(goals.progress(at(2))->distance_m, 7.0);
  EXPECT_DOUBLE_EQ(goals.progress(at(2))->remaining_s, 14.0);
  EXPECT_DOUBLE_EQ(goals.progress(at(2))->navigation_s, 2.0);
  set(RequestStatus::active, 2);
  double x = 0.0;
  for (double t = 2.1; t < 12.05; t += 0.1) {
    goals.drive(4.0 - x, false, at(t));
    goals.pose({x += 0.02, 0.0, {}});
  }
  const auto progress = goals.progress(at(12));
  EXPECT_NEAR(progress->distance_m, 2.0 + 3.0, 0.05) << "along its path, then as the crow flies";
  EXPECT_NEAR(progress->remaining_s, 5.0 / 0.2, 0.5) << "it drives at 0.2 m/s";
  EXPECT_NEAR(progress->map_from_base->x, 2.0, 0.01);
}

TEST_F(Navigation, CountsHowOftenTheWayIsBlocked) {
  begin(kFirst, {{4.0, 0.0, {}}}, 0);
  set(RequestStatus::active, 0.1);
  for (const bool is_blocked : {false, true, true, false, true}) goals.drive(3.0, is_blocked, at(0.2));
  EXPECT_EQ(goals.progress(at(1))->blocked, 2);
}

TEST_F(Navigation, AClockThatIsSetBackEndsNothing) {
  begin(kFirst, {{1.0, 0.0, {}}}, 50);
  set(RequestStatus::active, 51);
  pass(0, 3);  // a simulation that begins anew
  EXPECT_TRUE(ends.empty());
  deaf = true;
  speaks = true;
  goals.cancel(kFirst, at(3.1));
  take(3.1);
  pass(3.2, 8.3);
  EXPECT_EQ(ends.at(0).reason, "robot_silent");
}

TEST_F(Navigation, DeactivatingEndsWhatIsUnderWay) {
  begin(kFirst, {{1.0, 0.0, {}}}, 0);
  goals.deactivate(at(1));
  take(1);
  EXPECT_EQ(ends.at(0).outcome, GoalOutcome::aborted);
  EXPECT_EQ(shown[0].status, RequestStatus::cancelled);
}

TEST_F(Navigation, WhatIsNoPlaceIsRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(goals.refusal({kFirst, {}}), "");
  EXPECT_NE(goals.refusal({kFirst, {{nan, 0.0, {}}}}), "");
  EXPECT_NE(goals.refusal({kFirst, {{0.0, 20'000.0, {}}}}), "");
  EXPECT_NE(goals.refusal({kFirst, std::vector<Pose2>(101)}), "");
  EXPECT_EQ(goals.refusal({kFirst, std::vector<Pose2>(100)}), "");
}

TEST(HeadingOf, IsThatOfTheXAxis) {
  EXPECT_NEAR(heading_of(0.0, 0.0, 0.0, 1.0)->radians(), 0.0, 1e-12);
  EXPECT_NEAR(heading_of(0.0, 0.0, 0.7071, 0.7071)->degrees(), 90.0, 1e-3);
  EXPECT_NEAR(heading_of(0.0, 0.0, -0.7071, 0.7071)->degrees(), -90.0, 1e-3);
  EXPECT_NEAR(heading_of(0.0, 0.0, -0.70, -0.71)->degrees(), 90.0, 1.0) << "the same rotation, to two digits";
  EXPECT_FALSE(heading_of(0.0, 0.0, 0.0, 0.0)) << "left empty";
  EXPECT_FALSE(heading_of(0.0, 0.0, std::numeric_limits<double>::quiet_NaN(), 1.0));
  EXPECT_FALSE(heading_of(0.0, 0.0, 0.0, 87.0));
}

TEST(NavigationGoalParams, NamesWhatIsWrong) {
  EXPECT_EQ(NavigationGoalParams{}.fault(), "");
  NavigationGoalParams params;
  params.silence_s = params.resend_s;
  EXPECT_EQ(params.fault(), "silence_s must be > resend_s");
  params = {};
  params.speed = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(params.fault(), "speed must be > 0");
}

}  // namespace
}  // namespace docent::task_control
