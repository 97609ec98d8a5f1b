#include "docent/task_control/mission/mission.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "docent/task_control/mission/mission_fixture.h"

namespace docent::task_control {
namespace {

TEST_F(MissionTest, WakesUpFindsItselfAndStaysAtHome) {
  pass(1.0, false);
  EXPECT_EQ(phase(), MissionPhase::waking);
  EXPECT_EQ(mission->task().kind, Word<TaskKind>{}) << "the belief may come in any moment";
  pass(5.0, false);
  EXPECT_EQ(mission->task().kind, TaskKind::relocalize);
  pass(3.0);
  EXPECT_EQ(phase(), MissionPhase::idle);
  EXPECT_EQ(mission->task().id, "");
  EXPECT_TRUE(happened(EventKind::relocalizing) && happened(EventKind::localized));
}

TEST_F(MissionTest, ARobotThatIsSentAboutStaysWhereItIs) {
  params.goes_home = false;
  make({});
  robot = {5, 5};
  pass(2.0);
  mission->submit({"fleet", {}, RequestSource::staff, "", RequestKind::point, "8,5,1.57", -1, "en"}, time());
  EXPECT_EQ(mission->task().kind, TaskKind::point);
  EXPECT_NEAR(mission->task().map_from_base.theta.radians(), 1.57, 1e-9);
  report(TaskStatus::done);
  robot = {8, 5};
  EXPECT_EQ(status_of("fleet"), RequestStatus::fulfilled);
  pass(60.0);
  EXPECT_EQ(mission->task().id, "");
  EXPECT_EQ(phase(), MissionPhase::idle);
  battery(0.5);
  pass(1.0);
  EXPECT_EQ(mission->task().kind, TaskKind::charge) << "it charges nevertheless";
}

TEST_F(MissionTest, GoesHomeFromWhereItWokeUp) {
  robot = {4, 4};
  pass(5.0);
  EXPECT_EQ(phase(), MissionPhase::going_home);
  report(TaskStatus::failed);
  EXPECT_EQ(phase(), MissionPhase::waiting);
  pass(20.0);
  EXPECT_EQ(phase(), MissionPhase::waiting);
  pass(15.0);
  EXPECT_EQ(phase(), MissionPhase::going_home) << "it tries again";
  report(TaskStatus::done);
  EXPECT_EQ(phase(), MissionPhase::idle);
  pass(60.0);
  EXPECT_EQ(phase(), MissionPhase::idle) << "home is where it was told to be home";
}

TEST_F(MissionTest, AWishInterruptsTheWayHome) {
  robot = {4, 4};
  pass(5.0);
  const std::string home = mission->task().id;
  wish("1", RequestKind::exhibit, "a");
  EXPECT_EQ(mission->task().kind, TaskKind::visit);
  EXPECT_NE(mission->task().id, home);
  mission->report(home, TaskStatus::done, {}, time());
  EXPECT_EQ(phase(), MissionPhase::driving) << "the old task no longer counts";
}

TEST_F(MissionTest, AsksNobodyForMoreWhileOthersHaveWaitedLong) {
  pass(5.0);
  wish("1", RequestKind::tour, "both");
  EXPECT_TRUE(mission->task().offer_more);
  report(TaskStatus::explaining);
  wish("2", RequestKind::exhibit, "a");  // too late to join
  pass(60.0);
  report(TaskStatus::done);
  ASSERT_EQ(mission->task().exhibit_id, "a");
  EXPECT_TRUE(mission->task().offer_more) << "a minute is not long";
  report(TaskStatus::explaining);
  wish("3", RequestKind::exhibit, "a");
  pass(200.0);
  report(TaskStatus::done);
  ASSERT_EQ(mission->task().exhibit_id, "b");
  EXPECT_FALSE(mission->task().offer_more);
}

TEST_F(MissionTest, TalksToTheEndWhenItLosesItsPlace) {
  pass(5.0);
  wish("1", RequestKind::exhibit, "a");
  report(TaskStatus::explaining);
  pass(20.0, false);
  EXPECT_EQ(mission->task().kind, TaskKind::visit);
  report(TaskStatus::done);
  pass(4.0, false);
  EXPECT_EQ(phase(), MissionPhase::relocalizing);
}

TEST_F(MissionTest, AShortDoubtChangesNothing) {
  pass(5.0);
  wish("1", RequestKind::exhibit, "a");
  const std::string task = mission->task().id;
  pass(2.0, false);
  pass(5.0);
  EXPECT_EQ(mission->task().id, task);
}

TEST_F(MissionTest, ALongOneSuspendsTheTourAndResumesItWithANewTask) {
  pass(5.0);
  wish("t", RequestKind::tour, "both");
  const std::string task = mission->task().id;
  report(TaskStatus::driving);
  pass(6.0, false);
  EXPECT_EQ(phase(), MissionPhase::relocalizing);
  mission->report(task, TaskStatus::failed, ReasonWord::no_way, time());
  EXPECT_TRUE(mission->memory().schedule.visit) << "the suspended visit is not over";
  pass(3.0);
  EXPECT_EQ(mission->task().exhibit_id, "a");
  EXPECT_NE(mission->task().id, task);
  EXPECT_EQ(mission->task().tour_id, "both");
}

TEST_F(MissionTest, ARestartTakesUpTheRunningTaskUnderItsId) {
  pass(5.0);
  wish("1", RequestKind::exhibit, "a");
  report(TaskStatus::explaining);
  const MissionMemory memory = mission->memory();
  const std::string task = mission->task().id;
  make(memory);
  EXPECT_EQ(mission->task().id, task);
  pass(2.0);
  EXPECT_EQ(mission->task().id, task);
  mission->report(task, TaskStatus::done, {}, time());
  EXPECT_EQ(mission->memory().schedule.counters.requests_served, 1U);
  wish("2", RequestKind::exhibit, "b");
  EXPECT_NE(mission->task().id, task);
}

TEST_F(MissionTest, ARestartInARearrangedMuseumDrivesToWhereTheExhibitIsNow) {
  pass(5.0);
  wish("1", RequestKind::exhibit, "a");
  MissionMemory memory = mission->memory();
  const std::string task = mission->task().id;
  memory.schedule.visit->map_from_base.x = 7.0;
  memory.task.map_from_base.x = 7.0;
  make(memory);
  EXPECT_EQ(mission->task().map_from_base.x, 5.0);
  EXPECT_NE(mission->task().id, task);
}

TEST_F(MissionTest, ARestartInTheMiddleOfRelocalizingResumesTheVisit) {
  pass(5.0);
  wish("1", RequestKind::exhibit, "a");
  pass(6.0, false);
  EXPECT_EQ(mission->task().kind, TaskKind::relocalize);
  const MissionMemory memory = mission->memory();
  make(memory);
  EXPECT_EQ(mission->task().kind, TaskKind::visit);
  EXPECT_NE(mission->task().id, memory.task.id);
}

TEST_F(MissionTest, ChargesWhenTheBatteryIsLowAndServesAfterwardsWhoCameMeanwhile) {
  pass(5.0);
  wish("1", RequestKind::exhibit, "a");
  battery(0.12);
  EXPECT_EQ(phase(), MissionPhase::driving) << "what has begun is brought to its end";
  wish("2", RequestKind::exhibit, "b");
  report(TaskStatus::done);
  robot = {5, 0};
  pass(2.0);
  EXPECT_EQ(mission->task().kind, TaskKind::charge);
  EXPECT_EQ(mission->task().map_from_base.y, 3.0) << "the charger";
  EXPECT_EQ(mission->task().exhibit_id, "") << "nothing was broken off";
  report(TaskStatus::done);
  robot = {0, 3};
  battery(0.2, true);
  EXPECT_EQ(phase(), MissionPhase::charging);
  EXPECT_EQ(mission->summary(time()).charging_min, 5) << "0.05 more at 2.2e-4 1/s: enough for who waits";
  wish("3", RequestKind::exhibit, "a");
  pass(60.0);
  for (const char* id : {"2", "3"}) EXPECT_EQ(status_of(id), RequestStatus::queued) << id;
  EXPECT_EQ(mission->memory().schedule.board.find("3")->reason, ReasonWord::charging_first);
  battery(0.26, true);
  EXPECT_EQ(phase(), MissionPhase::driving) << "somebody waits: enough is enough";
  report(TaskStatus::done);
  report(TaskStatus::done);
  for (const char* id : {"2", "3"}) EXPECT_EQ(status_of(id), RequestStatus::fulfilled) << id;
}

TEST_F(MissionTest, AnOccupiedChargerIsTriedAgainAndTheStaffAreCalled) {
  pass(5.0);
  robot = {1, 3};
  battery(0.14);
  pass(2.0);
  ASSERT_EQ(mission->task().kind, TaskKind::charge);
  mission->report(mission->task().id, TaskStatus::driving, ReasonWord::charger_occupied, time());
  EXPECT_EQ(mission->summary(time()).charger_trouble, ReasonWord::charger_occupied);
  EXPECT_FALSE(happened(EventKind::staff_called)) << "it tries other ways first";
  mission->report(mission->task().id, TaskStatus::failed, ReasonWord::charger_occupied, time());
  pass(2.0);
  EXPECT_TRUE(happened(EventKind::charger_failed) && happened(EventKind::staff_called));
  EXPECT_NE(mission->staff_call(time()).find("14 % left"), std::string::npos) << mission->staff_call(time());
  pass(31.0);
  EXPECT_EQ(mission->task().kind, TaskKind::charge) << "again";
  report(TaskStatus::done);
  robot = {0, 3};
  for (double charge = 0.13; charge < 0.16; charge += 0.001) {
    battery(charge, true);
    pass(5.0);
  }
  EXPECT_EQ(mission->staff_call(time()), "");
  EXPECT_TRUE(mission->summary(time()).charger_trouble.is_none());
}

TEST_F(MissionTest, AtAChargerWithoutCurrentItBacksOffAndTriesAgain) {
  pass(5.0);
  robot = {0, 3};
  battery(0.14, true);  // so it says
  pass(5.0);
  EXPECT_EQ(phase(), MissionPhase::charging);
  for (double charge = 0.14; charge > 0.12; charge -= 0.0005) {
    battery(charge, true);
    pass(7.0);
  }
  EXPECT_TRUE(happened(EventKind::charger_failed) && happened(EventKind::staff_called));
  EXPECT_EQ(mission->summary(time()).charger_trouble, ReasonWord::charger_no_current);
  battery(0.12, true);
  pass(31.0);
  EXPECT_EQ(mission->task().kind, TaskKind::home) << "it backs off";
  report(TaskStatus::done);
  robot = {0, 0};
  battery(0.12, false);
  pass(31.0);
  EXPECT_EQ(mission->task().kind, TaskKind::charge) << "and docks anew";
}

TEST_F(MissionTest, DoesNotStayAtHomeWhenTheBatteryGotLowOnTheWayThere) {
  robot = {4, 4};
  pass(5.0);
  EXPECT_EQ(phase(), MissionPhase::going_home);
  const std::string home = mission->task().id;
  battery(0.14);
  mission->report(home, TaskStatus::done, {}, time());
  robot = {0, 0.5};
  pass(60.0);
  EXPECT_EQ(mission->task().map_from_base.y, 3.0) << "the charger";
  EXPECT_EQ(mission->task().kind, TaskKind::charge);
}

TEST_F(MissionTest, ASilentBatteryIsThoughtToGoOnAsItDid) {
  pass(5.0);
  battery(0.3);
  pass(60.0);
  EXPECT_TRUE(mission->is_battery_silent(time()));
  EXPECT_FALSE(mission->memory().must_charge);
  pass(1200.0);
  EXPECT_TRUE(mission->memory().must_charge);
}

TEST_F(MissionTest, AClosedMuseumServesWhatItTookAndTakesNoMore) {
  pass(5.0);
  wish("1", RequestKind::exhibit, "a");
  wish("2", RequestKind::exhibit, "b");
  mission->limits(false, OperatingMode::open);
  wish("3", RequestKind::exhibit, "a");
  report(TaskStatus::done);
  EXPECT_EQ(mission->task().exhibit_id, "b");
  report(TaskStatus::done);
  pass(1.0);
  EXPECT_EQ(mission->memory().schedule.board.find("3")->status, RequestStatus::refused);
  EXPECT_EQ(mission->memory().schedule.counters.requests_served, 2U);
}

TEST(MissionParamsTest, RefusesNonsenseByName) {
  MissionParams params;
  EXPECT_TRUE(params.validate());
  params.battery_full = 0.1;
  ASSERT_FALSE(params.validate());
  EXPECT_NE(params.validate().error().message.find("battery_full"), std::string::npos);
  params = {};
  params.schedule.overdue_s = -1.0;
  EXPECT_NE(params.validate().error().message.find("overdue_s"), std::string::npos);
}

TEST_F(MissionTest, AStopThatNobodyWantsIsLeftAtOnceWhateverTheRobotIsAt) {
  const auto skip = [&](const std::string& exhibit, RequestSource source = RequestSource::kiosk) {
    mission->submit({"skip-" + exhibit, {}, source, "", RequestKind::skip, exhibit, -1, "en"}, time());
  };
  pass(5.0);
  mission->submit({"t", {}, RequestSource::kiosk, "", RequestKind::tour, "both", -1, "en"}, time());
  const std::string first = mission->task().id;
  skip("b");
  skip("a", RequestSource::web);
  EXPECT_EQ(mission->task().id, first) << "not the stop under way; not theirs";
  report(TaskStatus::explaining);
  skip("a");
  EXPECT_EQ(mission->task().exhibit_id, "b") << "though it was explaining";
  EXPECT_NE(mission->task().id, first);
  mission->report(first, TaskStatus::done, {}, time());
  EXPECT_EQ(mission->task().exhibit_id, "b") << "what comes late of the stop that was left counts for nothing";
  report(TaskStatus::explaining);
  report(TaskStatus::done);
  EXPECT_EQ(status_of("t"), RequestStatus::fulfilled);
  EXPECT_EQ(mission->memory().schedule.board.find("skip-a"), nullptr) << "no wish of its own";
}

TEST_F(MissionTest, EndsATourWithAFarewell) {
  pass(5.0);
  wish("t", RequestKind::tour, "both");
  for (const char* exhibit : {"a", "b"}) {
    ASSERT_EQ(mission->task().exhibit_id, exhibit);
    report(TaskStatus::explaining);
    pass(20.0);
    report(TaskStatus::done);
  }
  EXPECT_EQ(status_of("t"), RequestStatus::fulfilled);
  EXPECT_EQ(mission->task().kind, TaskKind::farewell);
  EXPECT_TRUE(mission->summary(time()).says_farewell);
  wish("next", RequestKind::exhibit, "a");
  pass(2.0, false);
  make(mission->memory());
  EXPECT_EQ(mission->task().kind, TaskKind::farewell) << "a wish, a doubt and a restart do not cut it off";
  pass(2.0);
  report(TaskStatus::done);
  EXPECT_TRUE(happened(EventKind::farewell));
  pass(2.0);
  EXPECT_EQ(mission->task().exhibit_id, "a");
}

TEST_F(MissionTest, LearnsHowLongWaysAndVisitsTake) {
  pass(5.0);
  for (const char* id : {"1", "2"}) {
    robot = {0, 0};
    pass(1.0);
    wish(id, RequestKind::exhibit, "a");
    pass(40.0);  // for five metres
    robot = {5, 0};
    report(TaskStatus::explaining);
    pass(20.0);
    report(TaskStatus::done);
    report(TaskStatus::done);  // it is home again
  }
  const auto table = travel_table(mission->scheduler().times().rows());
  ASSERT_EQ(table.size(), 1U);
  EXPECT_EQ(table.front().from, "home");
  EXPECT_EQ(table.front().to, "a");
  EXPECT_EQ(table.front().examples, 2);
  EXPECT_NEAR(table.front().mean_s, 40.0, 0.6);
  EXPECT_FALSE(mission->memory().lessons.empty());
  mission->mark_stored();
  EXPECT_TRUE(mission->memory().lessons.empty());
}

}  // namespace
}  // namespace docent::task_control
