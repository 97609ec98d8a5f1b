#include "docent/task_control/mission/mission_fixture.h"

// Every third tour is the Web's ([Minerva2000] 6.4).

namespace docent::task_control {
namespace {

class Votes : public MissionTest {
 protected:
  Votes() { pass(3.0); }
  /// Serves whatever is under way or waits; returns the tours in the order in which they began.
  std::vector<std::string> serve(int tasks) {
    std::vector<std::string> tours;
    for (int i = 0; i < tasks; ++i) {
      const TaskOrder task = mission->task();
      if (!task.tour_id.empty() && task.kind == TaskKind::visit && task.exhibit_id == "a")
        tours.push_back(task.tour_id);
      robot = task.map_from_base.position();
      if (!task.id.empty()) report(TaskStatus::done);
      pass(1.0);
    }
    return tours;
  }
};

TEST_F(Votes, TheThirdTourIsTheirs) {
  programme.tours.push_back({"other", {"a"}, 0.0});
  make({});
  pass(3.0);
  mission->votes("round-1", "other", time());
  for (int i = 0; i < 4; ++i) {
    wish("t" + std::to_string(i), RequestKind::tour, "both");
    serve(4);
  }
  // Two tours for the hall, then that of the vote, then the hall's again.
  EXPECT_EQ(status_of("round-1"), RequestStatus::fulfilled);
  std::vector<std::string> began;
  for (const auto& happening : mission->take_happenings()) {
    if (happening.kind == EventKind::tour_started) began.push_back(happening.subject);
  }
  ASSERT_GE(began.size(), 4U);
  EXPECT_EQ(began[0], "both");
  EXPECT_EQ(began[1], "both");
  EXPECT_EQ(began[2], "other");
  EXPECT_EQ(began[3], "both");
}

TEST_F(Votes, NobodyVoted) {
  mission->votes("round-1", "", time());
  for (int i = 0; i < 4; ++i) {
    wish("t" + std::to_string(i), RequestKind::tour, "both");
    serve(4);
  }
  EXPECT_EQ(mission->memory().schedule.board.find("round-1"), nullptr);
}

TEST_F(Votes, AnIdleRobotGivesThemATourAfterAWhile) {
  mission->votes("round-1", "both", time());
  pass(params.vote_idle_s - 5.0);
  EXPECT_EQ(mission->memory().schedule.board.find("round-1"), nullptr);
  pass(10.0);
  EXPECT_EQ(status_of("round-1"), RequestStatus::active);
  // The same round is not given twice, though its votes are still told.
  serve(6);
  EXPECT_EQ(status_of("round-1"), RequestStatus::fulfilled);
  mission->votes("round-1", "both", time());
  pass(params.vote_idle_s + 30.0);
  EXPECT_EQ(mission->memory().schedule.counters.tours_completed, 1U);
}

TEST_F(Votes, CountOnlyInAnOpenMuseum) {
  mission->limits(true, OperatingMode::web);
  mission->votes("round-1", "both", time());
  pass(params.vote_idle_s + 30.0);
  EXPECT_EQ(mission->memory().schedule.board.find("round-1"), nullptr);
}

TEST_F(Votes, APointIsATaskOfItsOwn) {
  mission->limits(true, OperatingMode::web);
  wish("p", RequestKind::point, "4,4");
  EXPECT_EQ(mission->task().kind, TaskKind::point);
  EXPECT_FALSE(mission->task().offer_more);
  EXPECT_TRUE(mission->summary(time()).is_point);
  EXPECT_EQ(mission->summary(time()).exhibit_id, "");
  report(TaskStatus::done);
  EXPECT_EQ(status_of("p"), RequestStatus::fulfilled);
  EXPECT_TRUE(happened(EventKind::point_reached));
  EXPECT_FALSE(happened(EventKind::explained));
}

}  // namespace
}  // namespace docent::task_control
