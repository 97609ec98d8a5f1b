#include "docent/task_control/golog_planner/golog_planner.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "docent/base/files.h"
#include "docent/base/shipped_files.h"
#include "docent/task_control/mission/mission.h"

namespace docent::task_control {
namespace {

/// Three exhibits on a line, as in [Rhino1999] Figs. 21 and 22: e5 lies between e1 and e12.
Programme line_museum() {
  Programme programme;
  programme.languages = {"en", "de"};
  for (const auto& [id, x] : {std::pair{"e1", 4.0}, std::pair{"e5", 9.0}, std::pair{"e12", 20.0}}) {
    ProgrammeExhibit& exhibit = programme.exhibits.emplace_back();
    exhibit.id = id;
    exhibit.pose = {x, 0, {}};
  }
  programme.tours = {{"back", {"e12", "e1"}, 0.0}, {"forth", {"e1", "e12"}, 0.0}};
  programme.home = {0, 0, {}};
  programme.charger = Pose2{0, 3, {}};
  return programme;
}

/// The mission with a program; the test is the executive.
class GologPlannerTest : public testing::Test {
 protected:
  void start(const std::filesystem::path& file, MissionMemory memory = {}) {
    auto program = GologProgram::load(params.program, file, line_museum(), straight_distance());
    ASSERT_TRUE(program) << program.error().message;
    memory.deployment = "dep";
    mission = std::make_unique<Mission>(MissionParams{}, line_museum(), straight_distance(), std::move(memory),
                                        std::make_unique<GologPlanner>(params, std::move(*program)), time());
    pass(5.0);
  }
  void start_shipped(MissionMemory memory = {}) { start(shipped_path("prolog/tour_guide.pl"), std::move(memory)); }
  [[nodiscard]] Time time() const { return time_from_seconds(now_s); }
  void pass(double duration_s, bool is_localized = true) {
    for (const double end = now_s + duration_s; now_s < end; now_s += 0.5) {
      mission->localization(is_localized, robot, time());
      mission->tick(time());
    }
  }
  void wish(const std::string& id, RequestKind kind, const std::string& target) {
    mission->submit({id, {}, RequestSource::web, "", kind, target, -1, "en"}, time());
    pass(0.5);
  }
  /// "drive e1": what the robot does now.
  [[nodiscard]] std::string task() const {
    const TaskOrder& order = mission->task();
    return order.id.empty() ? "" : order.kind.text() + (order.exhibit_id.empty() ? "" : " " + order.exhibit_id);
  }
  void report(TaskStatus status, bool took_long = false) {
    const TaskOrder order = mission->task();
    if (status == TaskStatus::done &&
        (order.kind == TaskKind::home || order.kind == TaskKind::charge || order.kind.text() == "drive"))
      robot = order.map_from_base.position();
    mission->report(order.id, status, ReasonWord::way_blocked, time(), took_long);
    pass(0.5);
  }
  [[nodiscard]] RequestStatus status_of(const std::string& id) {
    return mission->memory().schedule.board.find(id)->status;
  }
  /// Every action succeeds, until there is nothing to do; what the robot did.
  std::vector<std::string> run(int most = 30) {
    std::vector<std::string> tasks;
    while (!task().empty() && most-- > 0) {
      tasks.push_back(task());
      report(TaskStatus::done);
    }
    return tasks;
  }

  GologPlannerParams params;
  double now_s = 0.0;
  Point2 robot{0, 0};
  std::unique_ptr<Mission> mission;
};

using Tasks = std::vector<std::string>;

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
  const auto file = std::filesystem::temp_directory_path() / ("docent_golog_" + std::to_string(getpid()) + ".pl");
  ASSERT_TRUE(write_file_atomically(file, "proc(main, [?(some(E, due(E))), while(true, ?(true))]).\n"));
  params.program.most_inferences = 100000;
  start(file);
  std::filesystem::remove(file);
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

TEST_F(GologPlannerTest, WhatTheStandInWasAboutGoesOnAfterARestart) {
  const auto file = std::filesystem::temp_directory_path() / ("docent_golog_again_" + std::to_string(getpid()) + ".pl");
  ASSERT_TRUE(write_file_atomically(file, "proc(main, [?(some(E, due(E))), while(true, ?(true))]).\n"));
  params.program.most_inferences = 100000;
  start(file);
  wish("t", RequestKind::tour, "back");
  ASSERT_EQ(task(), "visit e12") << "the plan controller stands in";
  const std::string id = mission->task().id;
  start(file, mission->memory());
  std::filesystem::remove(file);
  EXPECT_EQ(mission->task().id, id) << "an executive that works on it is not disturbed";
  EXPECT_NE(mission->planner_fault(), "");
  EXPECT_EQ(run(), (Tasks{"visit e12", "visit e1", "farewell"}));
  EXPECT_EQ(status_of("t"), RequestStatus::fulfilled);
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

}  // namespace
}  // namespace docent::task_control
