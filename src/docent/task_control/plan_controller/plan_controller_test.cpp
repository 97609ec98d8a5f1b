#include "docent/task_control/plan_controller/plan_controller.h"

#include <gtest/gtest.h>

#include "docent/task_control/mission/mission_fixture.h"

namespace docent::task_control {
namespace {

TEST_F(MissionTest, LeavesHomeWhenTheBatteryGetsLowThere) {
  pass(5.0);
  EXPECT_EQ(phase(), MissionPhase::idle);
  battery(0.14);
  pass(2.0);
  EXPECT_EQ(mission->task().kind, TaskKind::charge);
}

TEST_F(MissionTest, LeavesInTimeForTheWay) {
  pass(5.0);
  robot = {700, 3};  // 2000 s at 0.35 m/s: 0.28 of the charge
  battery(0.44);
  pass(1.0);
  EXPECT_NE(mission->task().map_from_base.y, 0.0);
  battery(0.42);
  EXPECT_TRUE(mission->memory().must_charge);
}

TEST_F(MissionTest, ABatteryThatDrainsFasterThanForeseenCallsItEarlier) {
  pass(5.0);
  robot = {300, 3};  // 857 s
  for (double charge = 0.5; charge > 0.45; charge -= 0.01) {
    battery(charge);
    pass(20.0);
  }
  EXPECT_TRUE(mission->memory().must_charge) << "5e-4 1/s: the way takes 0.43";
}

TEST_F(MissionTest, BreaksOffATourBetweenTwoExplanationsWithAWord) {
  pass(5.0);
  wish("t", RequestKind::tour, "both");
  report(TaskStatus::explaining);
  battery(0.05);
  EXPECT_EQ(phase(), MissionPhase::explaining) << "the sentence is finished";
  report(TaskStatus::done);
  EXPECT_EQ(mission->task().kind, TaskKind::charge);
  EXPECT_EQ(mission->task().tour_id, "both") << "this is said";
  EXPECT_EQ(status_of("t"), RequestStatus::queued);
  EXPECT_TRUE(happened(EventKind::tour_broken_off));
  battery(0.45, true);
  EXPECT_EQ(mission->task().tour_id, "both") << "it goes on where it stood";
  EXPECT_EQ(mission->task().exhibit_id, "b");
  battery(0.05);
  EXPECT_EQ(mission->task().kind, TaskKind::charge) << "under way to an exhibit it turns round at once";
  EXPECT_EQ(mission->task().exhibit_id, "b");
  EXPECT_EQ(mission->memory().schedule.counters.tours_completed, 0U);
}

TEST_F(MissionTest, BeginsNoTourThatWouldTakeMoreThanThereIs) {
  params.battery_soon = 0.0;
  make({});
  pass(5.0);
  battery(0.16);
  EXPECT_FALSE(mission->memory().must_charge);
  wish("t", RequestKind::tour, "both");
  EXPECT_EQ(mission->task().kind, TaskKind::charge);
  EXPECT_EQ(status_of("t"), RequestStatus::queued);
  battery(0.41, true);
  EXPECT_EQ(mission->task().tour_id, "both");
}

TEST_F(MissionTest, InAQuietHourItChargesWhenAQuarterIsMissing) {
  params.charging.busy_share = 1.0;  // no hour is busy
  make({});
  pass(5.0);
  battery(0.75);
  pass(1.0);
  EXPECT_EQ(phase(), MissionPhase::idle);
  battery(0.65);
  EXPECT_EQ(mission->task().kind, TaskKind::charge);
  report(TaskStatus::done);
  robot = {0, 3};
  battery(0.66, true);
  EXPECT_EQ(phase(), MissionPhase::charging);
  wish("1", RequestKind::exhibit, "a");
  EXPECT_EQ(phase(), MissionPhase::driving) << "it leaves at once";
  battery(0.66);
  report(TaskStatus::done);
  EXPECT_EQ(mission->task().kind, TaskKind::charge) << "and comes back";
  report(TaskStatus::done);
  battery(0.96, true);
  pass(15.0);
  EXPECT_EQ(mission->task().kind, TaskKind::home);
}

TEST_F(MissionTest, InABusyHourItChargesInEveryGap) {
  pass(5.0);
  battery(0.9);
  pass(1.0);
  EXPECT_EQ(phase(), MissionPhase::idle);
  battery(0.86);
  EXPECT_EQ(mission->task().kind, TaskKind::charge);
  report(TaskStatus::done);
  robot = {0, 3};
  battery(0.86, true);
  wish("1", RequestKind::exhibit, "a");
  EXPECT_EQ(phase(), MissionPhase::driving) << "it leaves at once";
}

TEST_F(MissionTest, TriesAgainWhenTheChargerDoesNotCharge) {
  pass(5.0);
  battery(0.1);
  const std::string first = mission->task().id;
  EXPECT_EQ(mission->task().kind, TaskKind::charge);
  report(TaskStatus::done);
  robot = {0, 3};
  battery(0.1, false);
  pass(5.0);
  EXPECT_EQ(mission->task().id, "") << "contacts take a moment";
  pass(6.0);
  EXPECT_EQ(mission->task().kind, TaskKind::charge);
  EXPECT_NE(mission->task().id, first);
  report(TaskStatus::failed);
  pass(20.0);
  EXPECT_EQ(mission->task().id, "") << "people stand on it";
  pass(15.0);
  EXPECT_EQ(mission->task().kind, TaskKind::charge);
  report(TaskStatus::done);
  battery(0.1, std::nullopt);
  pass(60.0);
  EXPECT_EQ(phase(), MissionPhase::charging) << "the battery does not say: the place counts";
}

TEST_F(MissionTest, AMuseumWithoutAChargerLetsItRestAtHome) {
  programme.charger.reset();
  make({});
  pass(5.0);
  wish("1", RequestKind::exhibit, "a");
  battery(0.05);
  EXPECT_EQ(mission->task().kind, Word<TaskKind>{}) << "home is where it stands";
  EXPECT_EQ(status_of("1"), RequestStatus::queued);
  pass(60.0);
  battery(1.0);  // somebody changed the battery
  EXPECT_EQ(mission->task().kind, TaskKind::visit);
}

TEST_F(MissionTest, ARestartGoesOnCharging) {
  pass(5.0);
  battery(0.1);
  const std::string task = mission->task().id;
  MissionMemory memory = mission->memory();
  make(memory);
  EXPECT_EQ(mission->task().id, task) << "the way to the charger goes on";
  report(TaskStatus::done);
  robot = {0, 3};
  battery(0.2, true);
  memory = mission->memory();
  make(memory);
  wish("1", RequestKind::exhibit, "a");
  battery(0.2, true);
  pass(5.0);
  EXPECT_EQ(phase(), MissionPhase::charging);
  EXPECT_EQ(status_of("1"), RequestStatus::queued);
}

TEST_F(MissionTest, ChargesBetweenTwoToursBeforeItMust) {
  pass(5.0);
  wish("t", RequestKind::tour, "both");
  battery(0.24);
  EXPECT_EQ(mission->task().kind, TaskKind::visit) << "a tour that has begun goes on";
  for (int stop = 0; stop < 2; ++stop) {
    report(TaskStatus::explaining);
    report(TaskStatus::done);
  }
  EXPECT_EQ(mission->task().kind, TaskKind::farewell);
  wish("1", RequestKind::exhibit, "a");
  report(TaskStatus::done);
  EXPECT_EQ(mission->task().kind, TaskKind::visit) << "somebody waits";
  EXPECT_EQ(status_of("t"), RequestStatus::fulfilled);
  battery(0.22);
  report(TaskStatus::done);
  EXPECT_EQ(mission->task().kind, TaskKind::charge) << "nobody does";
  robot = {0, 3};
  report(TaskStatus::done);
  battery(0.23, true);
  wish("2", RequestKind::exhibit, "b");
  EXPECT_EQ(status_of("2"), RequestStatus::queued);
  battery(0.26, true);
  EXPECT_EQ(mission->task().kind, TaskKind::visit) << "enough for who waits";
}

TEST_F(MissionTest, ABatteryThatDoesNotLastShortensTheTour) {
  programme.exhibits.push_back({"c", {400, 0, {}}, {}, 20.0, false});
  programme.tours = {{"all", {"a", "b", "c"}, 0.0}};
  make({});
  pass(5.0);
  wish("t", RequestKind::tour, "all");
  report(TaskStatus::explaining);
  battery(0.2);  // enough for b and the way to the charger, not for 780 m to c and back
  report(TaskStatus::done);
  EXPECT_EQ(mission->task().exhibit_id, "b");
  EXPECT_TRUE(happened(EventKind::plan_shortened));
  report(TaskStatus::explaining);
  report(TaskStatus::done);
  EXPECT_EQ(mission->task().kind, TaskKind::farewell);
  EXPECT_EQ(status_of("t"), RequestStatus::fulfilled);
  EXPECT_EQ(mission->memory().schedule.board.find("t")->reason, Reason(ReasonWord::not_reached, "c"))
      << "it says what it left out";
}

TEST_F(MissionTest, ServesWhileItsChargerIsOccupied) {
  pass(5.0);
  battery(0.24);
  wish("1", RequestKind::exhibit, "a");
  EXPECT_EQ(mission->task().kind, TaskKind::charge);
  report(TaskStatus::failed);
  EXPECT_EQ(mission->task().kind, TaskKind::visit) << "there is charge enough";
  report(TaskStatus::done);
  pass(40.0);
  EXPECT_EQ(mission->task().kind, TaskKind::charge) << "it tries again";
}

TEST_F(MissionTest, AttractsPeopleWhileItRestsAndNobodyWantsAnything) {
  pass(5.0);
  EXPECT_EQ(mission->task().kind.text(), "") << "nobody is there";
  mission->company(true);
  pass(1.0);
  EXPECT_EQ(mission->task().kind, TaskKind::mingle);
  EXPECT_EQ(phase(), MissionPhase::idle);
  const std::string first = mission->task().id;
  report(TaskStatus::done);
  pass(params.mingle_pause_s - 1.0);
  EXPECT_EQ(mission->task().id, "");
  pass(2.0);
  EXPECT_EQ(mission->task().kind, TaskKind::mingle);
  EXPECT_NE(mission->task().id, first);
  wish("r", RequestKind::exhibit, "a");
  EXPECT_EQ(mission->task().kind, TaskKind::visit) << "a wish ends it at once";
}

TEST_F(MissionTest, AttractsNobodyInWebHoursOrWithALowBatteryOrWhenItIsToldNotTo) {
  mission->company(true);
  mission->limits(true, OperatingMode::web);
  pass(5.0);
  EXPECT_EQ(phase(), MissionPhase::idle);
  EXPECT_EQ(mission->task().id, "");
  mission->limits(true, OperatingMode::open);
  battery(0.14);
  pass(1.0);
  EXPECT_EQ(mission->task().kind, TaskKind::charge);
  params.mingles = false;
  make({});
  mission->company(true);
  pass(5.0);
  EXPECT_EQ(phase(), MissionPhase::idle);
  EXPECT_EQ(mission->task().id, "");
}

}  // namespace
}  // namespace docent::task_control
