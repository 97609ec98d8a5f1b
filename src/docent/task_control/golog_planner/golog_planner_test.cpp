#include "docent/task_control/golog_planner/golog_planner.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "docent/task_control/golog_planner/golog_planner_fixture.h"

namespace docent::task_control {
namespace {

// [Rhino1999] Figs. 21 and 22.
TEST_F(GologPlannerTest, ARequestThatComesDuringAnExplanationChangesTheOrder) {
  start_shipped();
  EXPECT_EQ(task(), "");
  wish("12", RequestKind::exhibit, "e12");
  wish("1", RequestKind::exhibit, "e1");
  Tasks done;
  done.push_back(task());
  report(TaskStatus::done);
  EXPECT_EQ(task(), done.front() == "drive e1" ? "explain e1" : "explain e12");
  done.clear();
  wish("5", RequestKind::exhibit, "e5");
  for (const std::string& next : run()) done.push_back(next);
  const auto at = [&](const std::string& what) { return std::find(done.begin(), done.end(), what) - done.begin(); };
  EXPECT_LT(at("explain e5"), static_cast<long>(done.size()));
  EXPECT_EQ(done.back(), "home");
  for (const char* id : {"1", "5", "12"}) EXPECT_EQ(status_of(id), RequestStatus::fulfilled) << id;
  EXPECT_EQ(mission->memory().schedule.counters.requests_served, 3U);
}

TEST_F(GologPlannerTest, OffersMoreAndTellsMore) {
  start_shipped();
  wish("1", RequestKind::exhibit, "e1");
  EXPECT_EQ(task(), "drive e1");
  EXPECT_EQ(status_of("1"), RequestStatus::active);
  report(TaskStatus::done);
  EXPECT_EQ(task(), "explain e1");
  report(TaskStatus::explaining);
  report(TaskStatus::done);
  EXPECT_EQ(status_of("1"), RequestStatus::fulfilled);
  EXPECT_EQ(task(), "ask_more e1");
  report(TaskStatus::done, true);
  EXPECT_EQ(task(), "explain_more e1");
  report(TaskStatus::done);
  EXPECT_EQ(task(), "home");
}

TEST_F(GologPlannerTest, ATourKeepsItsOrderAndEndsWithAFarewell) {
  start_shipped();
  wish("t", RequestKind::tour, "back");
  Tasks said;
  for (const std::string& task : run()) {
    if (!task.starts_with("ask_more")) said.push_back(task);
  }
  EXPECT_EQ(said, (Tasks{"drive e12", "explain e12", "drive e1", "explain e1", "farewell", "home"}));
  EXPECT_EQ(status_of("t"), RequestStatus::fulfilled);
  EXPECT_EQ(mission->memory().schedule.counters.tours_completed, 1U);
}

TEST_F(GologPlannerTest, ATourMayBeginWhereItStands) {
  start_shipped();
  wish("12", RequestKind::exhibit, "e12");
  report(TaskStatus::done);
  EXPECT_EQ(task(), "explain e12");
  report(TaskStatus::explaining);
  wish("t", RequestKind::tour, "back");
  report(TaskStatus::done);
  EXPECT_EQ(status_of("12"), RequestStatus::fulfilled);
  run();
  EXPECT_EQ(status_of("t"), RequestStatus::fulfilled);
  EXPECT_EQ(mission->memory().schedule.counters.exhibits_explained, 3U);
}

TEST_F(GologPlannerTest, WhatCannotBeReachedIsTriedAgainAndOthersAreServedMeanwhile) {
  start_shipped();
  wish("1", RequestKind::exhibit, "e1");
  report(TaskStatus::failed);
  EXPECT_EQ(status_of("1"), RequestStatus::queued);
  wish("5", RequestKind::exhibit, "e5");
  EXPECT_EQ(task(), "drive e5");
  run();
  EXPECT_EQ(status_of("5"), RequestStatus::fulfilled);
  for (int i = 0; i < 40 && status_of("1") != RequestStatus::fulfilled; ++i) {
    pass(10.0);
    run();
  }
  EXPECT_EQ(status_of("1"), RequestStatus::fulfilled);
}

TEST_F(GologPlannerTest, FindsItselfAndGoesOn) {
  start_shipped();
  wish("1", RequestKind::exhibit, "e1");
  EXPECT_EQ(task(), "drive e1");
  pass(5.0, false);
  EXPECT_EQ(task(), "relocalize");
  EXPECT_EQ(status_of("1"), RequestStatus::queued);
  pass(3.0);
  EXPECT_EQ(task(), "drive e1");
  run();
  EXPECT_EQ(status_of("1"), RequestStatus::fulfilled);
}

TEST_F(GologPlannerTest, ChargesWhenItIsLowAndServesAfterwards) {
  start_shipped();
  mission->battery(0.12, false, time());
  wish("1", RequestKind::exhibit, "e1");
  pass(1.0);
  EXPECT_EQ(task(), "charge");
  report(TaskStatus::done);
  mission->battery(0.13, true, time());
  pass(20.0);
  EXPECT_EQ(task(), "");
  EXPECT_EQ(status_of("1"), RequestStatus::queued);
  mission->battery(0.96, true, time());
  pass(1.0);
  EXPECT_EQ(task(), "drive e1");
}

TEST_F(GologPlannerTest, ApproachesAChargerAgainThatDoesNotCharge) {
  start_shipped();
  mission->battery(0.12, false, time());
  pass(1.0);
  ASSERT_EQ(task(), "charge");
  const std::string first = mission->task().id;
  report(TaskStatus::done);
  EXPECT_EQ(task(), "");
  for (int i = 0; i < 40; ++i) {
    mission->battery(0.12, false, time());
    pass(1.0);
  }
  EXPECT_EQ(task(), "charge");
  EXPECT_NE(mission->task().id, first);
}

TEST_F(GologPlannerTest, ATourIsBrokenOffForTheChargerAndGivenAnew) {
  start_shipped();
  wish("t", RequestKind::tour, "back");
  report(TaskStatus::done);
  ASSERT_EQ(task(), "explain e12");
  mission->battery(0.15, false, time());
  report(TaskStatus::explaining);
  report(TaskStatus::done);
  EXPECT_EQ(task(), "charge");
  EXPECT_EQ(mission->task().tour_id, "back") << "so that the robot says a word to its visitors";
  EXPECT_EQ(status_of("t"), RequestStatus::queued);
  report(TaskStatus::done);
  const auto happenings = mission->take_happenings();
  const auto happened = [&](EventKind kind) {
    return std::any_of(happenings.begin(), happenings.end(), [&](const Happening& one) { return one.kind == kind; });
  };
  EXPECT_TRUE(happened(EventKind::tour_broken_off));
  EXPECT_TRUE(happened(EventKind::charger));
  mission->battery(0.16, true, time());
  pass(5.0);
  mission->battery(0.96, true, time());
  pass(1.0);
  run();
  EXPECT_EQ(status_of("t"), RequestStatus::fulfilled);
}

TEST_F(GologPlannerTest, ARestartGoesOnWithTheActionUnderWay) {
  start_shipped();
  wish("1", RequestKind::exhibit, "e1");
  report(TaskStatus::done);
  ASSERT_EQ(task(), "explain e1");
  const std::string id = mission->task().id;
  start_shipped(mission->memory());
  EXPECT_EQ(mission->task().id, id) << "an executive that works on it is not disturbed";
  report(TaskStatus::done);
  EXPECT_EQ(status_of("1"), RequestStatus::fulfilled);
  EXPECT_EQ(mission->memory().schedule.counters.exhibits_explained, 1U);
}

TEST_F(GologPlannerTest, AProgramThatRunsAwayIsReportedAndVisitorsAreServed) {
  golog.program.most_inferences = 100000;
  start_text("proc(main, [?(some(E, due(E))), while(true, ?(true))]).\n");
  EXPECT_EQ(mission->planner_fault(), "");
  wish("1", RequestKind::exhibit, "e1");
  EXPECT_NE(mission->planner_fault(), "");
  EXPECT_EQ(task(), "visit e1") << "the plan controller stands in";
  report(TaskStatus::explaining);
  report(TaskStatus::done);
  EXPECT_EQ(status_of("1"), RequestStatus::fulfilled);
}

TEST_F(GologPlannerTest, ATourThatBeginsWhereTheLastOneEndedIsGiven) {
  start_shipped();
  wish("t1", RequestKind::tour, "back");  // e12, e1
  while (task() != "explain e1") report(TaskStatus::done);
  wish("t2", RequestKind::tour, "forth");  // e1, e12
  wish("1", RequestKind::exhibit, "e5");
  const Tasks done = run(40);
  EXPECT_EQ(done.back(), "home");
  EXPECT_NE(std::find(done.begin(), done.end(), "visit e1"), done.end()) << "it stands there, and tells it again";
  for (const char* id : {"t1", "t2", "1"}) EXPECT_EQ(status_of(id), RequestStatus::fulfilled) << id;
}

TEST_F(GologPlannerTest, AsksForMoreInTheLanguageOfItsVisitors) {
  start_shipped();
  mission->submit({"1", {}, RequestSource::kiosk, "", RequestKind::exhibit, "e1", -1, "de"}, time());
  pass(0.5);
  EXPECT_EQ(mission->task().language, "de");
  while (task() != "ask_more e1") report(TaskStatus::done);
  EXPECT_EQ(mission->task().language, "de") << "though the visit is over";
  report(TaskStatus::done);
  EXPECT_EQ(task(), "home");
  EXPECT_EQ(mission->task().language, "en");
}

TEST_F(GologPlannerTest, WhatCannotBeReachedIsForgottenWhenItsRequestIsOver) {
  start_shipped();
  wish("1", RequestKind::exhibit, "e1");
  for (int i = 0; i < 3000 && status_of("1") != RequestStatus::failed; ++i) {
    if (task() == "drive e1") {
      report(TaskStatus::failed);
    } else if (!task().empty()) {
      report(TaskStatus::done);
    } else {
      pass(5.0);
    }
  }
  ASSERT_EQ(status_of("1"), RequestStatus::failed);
  Tasks later = run();
  for (int i = 0; i < 200; ++i) {
    pass(5.0);
    for (const std::string& next : run()) later.push_back(next);
  }
  EXPECT_EQ(std::count(later.begin(), later.end(), "drive e1"), 0) << "nobody waits for it any more";
  wish("5", RequestKind::exhibit, "e5");
  EXPECT_EQ(task(), "drive e5");
}

TEST_F(GologPlannerTest, WhatTheStandInWasAboutGoesOnAfterARestart) {
  const std::string runaway = "proc(main, [?(some(E, due(E))), while(true, ?(true))]).\n";
  golog.program.most_inferences = 100000;
  start_text(runaway);
  wish("t", RequestKind::tour, "back");
  ASSERT_EQ(task(), "visit e12") << "the plan controller stands in";
  const std::string id = mission->task().id;
  start_text(runaway, mission->memory());
  EXPECT_EQ(mission->task().id, id) << "an executive that works on it is not disturbed";
  EXPECT_NE(mission->planner_fault(), "");
  EXPECT_EQ(run(), (Tasks{"visit e12", "visit e1", "farewell"}));
  EXPECT_EQ(status_of("t"), RequestStatus::fulfilled);
}

// Between the drive to an exhibit and the end of its explanation a visit is under way.
TEST_F(GologPlannerTest, AProgramThatFailsInAVisitLeavesItToThePlanController) {
  golog.program.most_inferences = 100000;
  for (const char* last : {"drive(E)", "drive(E), explain(E)"}) {
    robot = {0, 0};
    start_text(std::string{"proc(main, [?(some(E, due(E))), pi(E, [?(next(E)), conc(["} + last +
               "], [?(robot_location(e1)), while(true, ?(true))])])]).\n");
    wish("1", RequestKind::exhibit, "e1");
    ASSERT_EQ(task(), "drive e1");
    report(TaskStatus::done);
    EXPECT_NE(mission->planner_fault(), "");
    EXPECT_EQ(task(), "visit e1") << "it is begun anew";
    report(TaskStatus::done);
    EXPECT_EQ(status_of("1"), RequestStatus::fulfilled);
    EXPECT_EQ(mission->memory().schedule.counters.requests_served, 1U);
  }
}

TEST_F(GologPlannerTest, AVisitOfAnotherProgramWaitsAgain) {
  start_shipped();
  wish("1", RequestKind::exhibit, "e1");
  report(TaskStatus::done);
  ASSERT_EQ(task(), "explain e1");
  start_text("proc(main, while(true, [?(some(E, due(E))), pi(E, [?(next(E)), drive(E), explain(E)])])).\n",
             mission->memory());
  EXPECT_EQ(task(), "drive e1") << "the program was changed while the robot was off";
  report(TaskStatus::done);
  ASSERT_EQ(task(), "explain e1");
  report(TaskStatus::done);
  EXPECT_EQ(status_of("1"), RequestStatus::fulfilled);
}

TEST_F(GologPlannerTest, ARestartInTheFarewellSaysItOnce) {
  start_shipped();
  wish("t", RequestKind::tour, "back");
  while (task() != "farewell") report(TaskStatus::done);
  const std::string id = mission->task().id;
  start_shipped(mission->memory());
  EXPECT_EQ(mission->task().id, id);
  report(TaskStatus::done);
  EXPECT_EQ(task(), "ask_more e1");
  EXPECT_FALSE(mission->task().offer_more) << "its visitors have left";
  EXPECT_EQ(run(), (Tasks{"ask_more e1", "home"}));
}

TEST_F(GologPlannerTest, WhoIsBusyDoesNothingBesideIt) {
  start_text("proc(main, [?(some(E, due(E))), conc(wait_for_request, pi(E, [?(next(E)), drive(E)]))]).\n");
  wish("1", RequestKind::exhibit, "e1");
  EXPECT_EQ(task().substr(0, 6), "mingle");
  EXPECT_FALSE(mission->situation(time()).has_visit) << "the drive has failed";
  EXPECT_EQ(status_of("1"), RequestStatus::queued);
}

TEST_F(GologPlannerTest, AtHomeItIsIdle) {
  start_shipped();
  wish("1", RequestKind::exhibit, "e1");
  run();
  pass(2.0);
  EXPECT_EQ(mission->summary(time()).phase, MissionPhase::idle);
}

TEST_F(GologPlannerTest, DoesNotDriveForAWishThatIsTakenBack) {
  start_shipped();
  wish("12", RequestKind::exhibit, "e12");
  wish("5", RequestKind::exhibit, "e5");
  ASSERT_EQ(task(), "drive e12");
  mission->submit({"c", {}, RequestSource::web, "", RequestKind::cancel, "12", -1, "en"}, time());
  pass(1.0);
  EXPECT_EQ(task(), "drive e5");
  const Tasks done = run();
  EXPECT_EQ(std::count(done.begin(), done.end(), "explain e12"), 0);
  EXPECT_EQ(status_of("12"), RequestStatus::cancelled);
  EXPECT_EQ(status_of("5"), RequestStatus::fulfilled);
}

TEST_F(GologPlannerTest, SaysNotForEverThatItMustChargeFirst) {
  start_shipped();
  mission->battery(0.12, false, time());
  pass(1.0);
  ASSERT_EQ(task(), "charge");
  report(TaskStatus::done);
  wish("1", RequestKind::exhibit, "e1");
  mission->battery(0.45, true, time());
  pass(1.0);
  ASSERT_EQ(task(), "drive e1") << "it is charged well enough for who waits";
  EXPECT_FALSE(mission->summary(time()).needs_charge);
  EXPECT_FALSE(mission->memory().must_charge);
}

TEST_F(GologPlannerTest, LearnsHowLongItsWaysTake) {
  start_shipped();
  wish("1", RequestKind::exhibit, "e1");
  report(TaskStatus::driving);
  pass(20.0);
  report(TaskStatus::done);
  const auto table = travel_table(mission->scheduler().times().rows());
  ASSERT_EQ(table.size(), 1U);
  EXPECT_EQ(table.front().to, "e1");
  EXPECT_NEAR(table.front().mean_s, 20.5, 1.0);
}

TEST_F(GologPlannerTest, AProgramThatHasEndedBeginsAgainWhenTheMuseumOpens) {
  start_shipped();
  mission->limits(false, OperatingMode::closed);
  pass(5.0);
  mission->limits(true, OperatingMode::open);
  pass(1.0);
  wish("1", RequestKind::exhibit, "e1");
  EXPECT_EQ(mission->planner_fault(), "");
  ASSERT_EQ(task(), "drive e1");
  run();
  EXPECT_EQ(status_of("1"), RequestStatus::fulfilled);
}

TEST_F(GologPlannerTest, AProgramThatHasEndedLeavesTheVisitorsToThePlanController) {
  start_text("proc(main, [goto(e1), explain(e1)]).\n");
  EXPECT_EQ(run(), (Tasks{"drive e1", "explain e1"}));
  EXPECT_EQ(mission->planner_fault(), "") << "nobody waits";
  wish("5", RequestKind::exhibit, "e5");
  EXPECT_NE(mission->planner_fault(), "");
  EXPECT_EQ(task(), "visit e5");
  report(TaskStatus::done);
  EXPECT_EQ(status_of("5"), RequestStatus::fulfilled);
}

TEST_F(GologPlannerTest, AnActionBesideAVisitGoesOnWhenItsWishIsTakenBack) {
  start_text(
      "proc(main, [?(some(E, due(E))), pi(E, [?(next(E)), drive(E)]), wave, ?(closing)]).\n"
      "action(wave).\nposs(wave, true).\n");
  wish("1", RequestKind::exhibit, "e1");
  ASSERT_EQ(task(), "drive e1");
  report(TaskStatus::done);
  ASSERT_EQ(task(), "wave");
  mission->submit({"c", {}, RequestSource::web, "", RequestKind::cancel, "1", -1, "en"}, time());
  pass(1.0);
  EXPECT_FALSE(mission->situation(time()).has_visit);
  EXPECT_EQ(task(), "wave");
}

TEST_F(GologPlannerTest, AProgramThatEndsItsProcessLeavesTheVisitorsToThePlanController) {
  start_text("proc(main, [?(request(e12)), ?(halt)]).\n");
  wish("a", RequestKind::exhibit, "e12");
  EXPECT_EQ(task(), "visit e12");
  EXPECT_NE(mission->planner_fault().find("ended by the program itself"), std::string::npos)
      << mission->planner_fault();
}

TEST_F(GologPlannerTest, AProgramWhoseProcessHasEndedIsToldAllAnew) {
  const auto folder = std::filesystem::temp_directory_path();
  const auto file = folder / ("docent_golog_anew_" + std::to_string(getpid()) + ".pl");
  const auto poison = folder / ("docent_golog_poison_" + std::to_string(getpid()));
  ASSERT_TRUE(write_file_atomically(poison, ""));
  ASSERT_TRUE(write_file_atomically(
      file,
      "proc(main, while(true, [?(some(E, due(E))), pi(E, [?(next(E)), ?(is_well), drive(E), explain(E)])])).\n"
      "is_well :- ( exists_file('" +
          poison.string() + "') -> halt ; true ).\n"));
  golog.retry_s = 1.0;
  start(file);
  wish("1", RequestKind::exhibit, "e1");
  ASSERT_EQ(task(), "visit e1") << "the plan controller stands in";
  std::filesystem::remove(poison);
  wish("2", RequestKind::exhibit, "e5");
  report(TaskStatus::done);
  pass(2.0);
  EXPECT_EQ(task(), "drive e5") << "the program is back, and knows of a wish that came meanwhile";
  EXPECT_EQ(mission->planner_fault(), "");
  std::filesystem::remove(file);
}

// No single moment has many actions, but none of them takes time.
TEST_F(GologPlannerTest, AProgramThatGoesToAndFroWithoutEndIsStopped) {
  start_text("proc(main, [?(some(E, due(E))), while(true, [drive(e1), drive(home)])]).\n");
  wish("1", RequestKind::exhibit, "e5");
  for (int i = 0; i < 200 && mission->planner_fault().empty(); ++i) {
    mission->report(TaskOrder{mission->task()}.id, TaskStatus::done, ReasonWord::way_blocked, time(), false);
    mission->tick(time());
  }
  EXPECT_NE(mission->planner_fault().find("comes to no end"), std::string::npos);
  pass(0.5);
  EXPECT_EQ(task(), "visit e5") << "the plan controller stands in";
}

}  // namespace
}  // namespace docent::task_control
