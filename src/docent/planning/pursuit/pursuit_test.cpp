#include "docent/planning/pursuit/pursuit.h"

#include <gtest/gtest.h>

namespace docent::planning {
namespace {

class PursuitTest : public ::testing::Test {
 protected:
  PursuitTest() : planner_{hall(), {}, {}, {}} {
    planner_.set_goal(goal_.map_from_goal.position(), 0.2);
    planner_.iterate(1000);
    pursuit_.set_goal(goal_, Time{});
  }
  static OccupancyGrid hall() {
    OccupancyGrid map;
    map.frame = {160, 160, 0.05, {0, 0}};
    map.cells.assign(map.frame.size(), 0);
    return map;
  }
  Pursuit step(Pose2 pose, double t) { return pursuit_.step(pose, planner_, time_from_seconds(t)); }

  PursuitGoal goal_{"g", {6, 4, Angle::degrees(90)}, 0.25, 0.1};
  RoutePlanner planner_;
  GoalPursuit pursuit_{PursuitParams{}};
};

TEST_F(PursuitTest, DrivesThenTurnsThenStays) {
  auto now = step({0.6, 4, {}}, 0.0);
  EXPECT_EQ(now.state, GoalStatus::driving);
  EXPECT_NEAR(now.remaining_m, 5.4, 0.4);
  EXPECT_FALSE(now.is_final) << "farther than the horizon";
  now = step({4, 4, {}}, 3.0);
  EXPECT_TRUE(now.is_final);
  now = step({5.9, 4, {}}, 6.0);
  EXPECT_EQ(now.state, GoalStatus::turning);
  EXPECT_NEAR(now.heading.degrees(), 90.0, 1e-9);
  now = step({5.9, 4, Angle::degrees(88)}, 7.0);
  EXPECT_EQ(now.state, GoalStatus::arrived);
  now = step({5.7, 4.2, Angle::degrees(70)}, 8.0);
  EXPECT_EQ(now.state, GoalStatus::arrived) << "a small jump of the pose does not undo it";
  now = step({4.5, 4, {}}, 9.0);
  EXPECT_EQ(now.state, GoalStatus::driving) << "pushed away, it drives again";
}

TEST_F(PursuitTest, SaysThatItIsBlocked) {
  EXPECT_EQ(step({2, 4, {}}, 0.0).state, GoalStatus::driving);
  EXPECT_EQ(step({2, 4, {}}, 3.0).state, GoalStatus::driving);
  const auto now = step({2.1, 4, {}}, 5.0);
  EXPECT_EQ(now.state, GoalStatus::blocked);
  EXPECT_NEAR(now.blocked_s, 5.0, 1e-9);
  EXPECT_EQ(now.mode, DriveMode::drive) << "it goes on trying";
  EXPECT_EQ(step({3, 4, {}}, 6.0).state, GoalStatus::driving);
}

TEST_F(PursuitTest, IsNotBlockedWhileSomebodyHoldsIt) {
  EXPECT_EQ(step({2, 4, {}}, 0.0).state, GoalStatus::driving);
  for (double t = 1.0; t < 60.0; t += 1.0) {
    pursuit_.hold(time_from_seconds(t));
    EXPECT_EQ(step({2.0 - 0.01 * t, 4, {}}, t).state, GoalStatus::driving) << t;
  }
  EXPECT_EQ(step({1.4, 4, {}}, 62.0).state, GoalStatus::driving);
  EXPECT_EQ(step({1.4, 4, {}}, 67.0).state, GoalStatus::blocked) << "let go, it is blocked as ever";
}

TEST_F(PursuitTest, SettlesBesideAGoalThatPeopleStandOn) {
  EXPECT_EQ(step({5.55, 4, {}}, 0.0).state, GoalStatus::driving);
  EXPECT_EQ(step({5.55, 4, {}}, 7.0).state, GoalStatus::turning);
}

TEST_F(PursuitTest, AGoalIsUnreachableOnlyWhenPlanningHasEnded) {
  RoutePlanner busy{hall(), {}, {}, {}};
  busy.set_goal(goal_.map_from_goal.position(), 0.2);
  EXPECT_EQ(pursuit_.step(Pose2{2, 4, {}}, busy, Time{}).state, GoalStatus::waiting);
  EXPECT_EQ(pursuit_.step(Pose2{2, 4, {}}, busy, time_from_seconds(4.0)).state, GoalStatus::unreachable)
      << "not for ever";
  auto walled = hall();
  for (int row = 0; row < walled.frame.rows; ++row) walled.cells[walled.frame.index({80, row})] = 100;
  RoutePlanner settled{walled, {}, {}, {}};
  settled.set_goal(goal_.map_from_goal.position(), 0.2);
  settled.iterate(1000);
  EXPECT_EQ(pursuit_.step(Pose2{2, 4, {}}, settled, Time{}).state, GoalStatus::unreachable);
}

TEST_F(PursuitTest, WaitsWhileItDoesNotKnowWhereItIs) {
  const auto now = pursuit_.step(std::nullopt, planner_, Time{});
  EXPECT_EQ(now.state, GoalStatus::waiting);
  EXPECT_EQ(now.mode, DriveMode::stop);
}

}  // namespace
}  // namespace docent::planning
