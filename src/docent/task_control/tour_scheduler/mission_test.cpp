#include "docent/task_control/tour_scheduler/mission.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace docent {
namespace {

Programme small_programme() {
  Programme programme;
  programme.languages = {"en"};
  programme.exhibits = {{"a", {5, 0, {}}, {}, 20.0, false}, {"b", {10, 0, {}}, {}, 20.0, false}};
  programme.tours = {{"both", {"a", "b"}, 0.0}};
  programme.home = {0, 0, {}};
  programme.charger = Pose2{0, 3, {}};
  return programme;
}

class MissionTest : public testing::Test {
 protected:
  MissionTest() { make({}); }
  void make(MissionMemory memory) {
    memory.deployment = "dep";
    mission =
        std::make_unique<Mission>(MissionParams{}, small_programme(), straight_distance(), std::move(memory), time());
  }
  [[nodiscard]] Time time() const { return time_from_seconds(now_s); }
  /// Passes time with ticks; the robot stays where it is.
  void pass(double duration_s, bool is_localized = true) {
    for (const double end = now_s + duration_s; now_s < end; now_s += 0.5) {
      mission->localization(is_localized, robot, time());
      mission->tick(time());
    }
  }
  void wish(const std::string& id, const std::string& kind, const std::string& target) {
    mission->submit({id, {}, "web", "", kind, target, -1, "en"}, time());
  }
  void report(const std::string& state) { mission->report(mission->task().id, state, "", time()); }
  [[nodiscard]] std::string phase() const { return mission->summary(time()).phase; }
  bool happened(const std::string& kind) {
    for (auto& happening : mission->take_happenings()) seen.push_back(happening.kind);
    return std::find(seen.begin(), seen.end(), kind) != seen.end();
  }

  double now_s = 0.0;
  Point2 robot{0, 0};
  std::unique_ptr<Mission> mission;
  std::vector<std::string> seen;
};

TEST_F(MissionTest, WakesUpFindsItselfAndStaysAtHome) {
  pass(1.0, false);
  EXPECT_EQ(phase(), "waking");
  EXPECT_EQ(mission->task().kind, "") << "the belief may come in any moment";
  pass(5.0, false);
  EXPECT_EQ(mission->task().kind, "relocalize");
  pass(3.0);
  EXPECT_EQ(phase(), "idle");
  EXPECT_EQ(mission->task().id, "");
  EXPECT_TRUE(happened("relocalizing") && happened("localized"));
}

TEST_F(MissionTest, GoesHomeFromWhereItWokeUp) {
  robot = {4, 4};
  pass(5.0);
  EXPECT_EQ(phase(), "going_home");
  report("failed");
  EXPECT_EQ(phase(), "waiting");
  pass(20.0);
  EXPECT_EQ(phase(), "waiting");
  pass(15.0);
  EXPECT_EQ(phase(), "going_home") << "it tries again";
  report("done");
  EXPECT_EQ(phase(), "idle");
  pass(60.0);
  EXPECT_EQ(phase(), "idle") << "home is where it was told to be home";
}

TEST_F(MissionTest, AWishInterruptsTheWayHome) {
  robot = {4, 4};
  pass(5.0);
  const std::string home = mission->task().id;
  wish("1", "exhibit", "a");
  EXPECT_EQ(mission->task().kind, "visit");
  EXPECT_NE(mission->task().id, home);
  mission->report(home, "done", "", time());
  EXPECT_EQ(phase(), "driving") << "the old task no longer counts";
}

TEST_F(MissionTest, AsksNobodyForMoreWhileOthersHaveWaitedLong) {
  pass(5.0);
  wish("1", "tour", "both");
  EXPECT_TRUE(mission->task().offer_more);
  report("explaining");
  wish("2", "tour", "both");  // too late to join
  pass(60.0);
  report("done");
  ASSERT_EQ(mission->task().exhibit_id, "b");
  EXPECT_TRUE(mission->task().offer_more) << "a minute is not long";
  report("done");
  ASSERT_EQ(mission->task().exhibit_id, "a");
  EXPECT_TRUE(mission->task().offer_more) << "nobody waits but those whose turn it is";
  report("explaining");
  wish("3", "tour", "both");
  pass(200.0);
  report("done");
  ASSERT_EQ(mission->task().exhibit_id, "b");
  EXPECT_FALSE(mission->task().offer_more);
}

TEST_F(MissionTest, TalksToTheEndWhenItLosesItsPlace) {
  pass(5.0);
  wish("1", "exhibit", "a");
  report("explaining");
  pass(20.0, false);
  EXPECT_EQ(mission->task().kind, "visit");
  report("done");
  pass(4.0, false);
  EXPECT_EQ(phase(), "relocalizing");
}

TEST_F(MissionTest, AShortDoubtChangesNothing) {
  pass(5.0);
  wish("1", "exhibit", "a");
  const std::string task = mission->task().id;
  pass(2.0, false);
  pass(5.0);
  EXPECT_EQ(mission->task().id, task);
}

TEST_F(MissionTest, ALongOneSuspendsTheTourAndResumesItWithANewTask) {
  pass(5.0);
  wish("t", "tour", "both");
  const std::string task = mission->task().id;
  report("driving");
  pass(6.0, false);
  EXPECT_EQ(phase(), "relocalizing");
  mission->report(task, "failed", "stopped", time());
  EXPECT_TRUE(mission->memory().schedule.visit) << "the suspended visit is not over";
  pass(3.0);
  EXPECT_EQ(mission->task().exhibit_id, "a");
  EXPECT_NE(mission->task().id, task);
  EXPECT_EQ(mission->task().tour_id, "both");
}

TEST_F(MissionTest, ARestartTakesUpTheRunningTaskUnderItsId) {
  pass(5.0);
  wish("1", "exhibit", "a");
  report("explaining");
  const MissionMemory memory = mission->memory();
  const std::string task = mission->task().id;
  make(memory);
  EXPECT_EQ(mission->task().id, task);
  pass(2.0);
  EXPECT_EQ(mission->task().id, task);
  mission->report(task, "done", "", time());
  EXPECT_EQ(mission->memory().schedule.counters.requests_served, 1U);
  wish("2", "exhibit", "b");
  EXPECT_NE(mission->task().id, task);
}

TEST_F(MissionTest, ARestartInARearrangedMuseumDrivesToWhereTheExhibitIsNow) {
  pass(5.0);
  wish("1", "exhibit", "a");
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
  wish("1", "exhibit", "a");
  pass(6.0, false);
  EXPECT_EQ(mission->task().kind, "relocalize");
  const MissionMemory memory = mission->memory();
  make(memory);
  EXPECT_EQ(mission->task().kind, "visit");
  EXPECT_NE(mission->task().id, memory.task.id);
}

TEST_F(MissionTest, RestsWhenTheBatteryIsLow) {
  pass(5.0);
  wish("1", "exhibit", "a");
  mission->battery(0.1);
  EXPECT_EQ(phase(), "driving") << "what has begun is brought to its end";
  wish("2", "exhibit", "b");
  report("done");
  robot = {5, 0};
  pass(2.0);
  EXPECT_EQ(phase(), "going_home");
  EXPECT_EQ(mission->task().map_from_base.y, 3.0) << "the charger";
  EXPECT_TRUE(mission->summary(time()).is_charging);
  report("done");
  robot = {0, 3};
  mission->battery(0.5);
  wish("3", "exhibit", "a");
  EXPECT_EQ(phase(), "idle");
  EXPECT_TRUE(happened("request_refused"));
  mission->battery(0.85);
  wish("4", "exhibit", "b");
  EXPECT_EQ(phase(), "driving");
}

TEST_F(MissionTest, AClosedMuseumServesWhatItTookAndTakesNoMore) {
  pass(5.0);
  wish("1", "exhibit", "a");
  wish("2", "exhibit", "b");
  mission->limits(false, "open");
  wish("3", "exhibit", "a");
  report("done");
  EXPECT_EQ(mission->task().exhibit_id, "b");
  report("done");
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

}  // namespace
}  // namespace docent
