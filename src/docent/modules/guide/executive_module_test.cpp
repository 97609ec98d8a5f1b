#include "docent/modules/guide/executive_module.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

#include "docent/modules/shared/module_bench.h"
#include "docent/transport/create3_support.h"

namespace docent::modules {
namespace {

/// The executive with a museum of one exhibit. The test is mission, plan and sound.
class ExecutiveModule : public ModuleBench {
 protected:
  ExecutiveModule() : ModuleBench{"executive", make_executive} {
    museum::Exhibit vase;
    vase.id = "vase";
    vase.title = {{"en", "The Vase"}, {"de", "Die Vase"}};
    vase.short_text = {{"en", "It is old."}, {"de", "Sie ist alt."}};
    museum.exhibits.push_back(vase);
    museum.languages = {"en", "de"};
    museum.map.frame = {2, 2, 0.05, {}};
    museum.map.cells.assign(4, 0);
    keep(topics::kDriveGoal, goal, goals);
    keep(topics::kSay, line, lines);
    keep(topics::kTaskState, progress, reports);
    keep(topics::kHorn, horn, horns);
    world->subscribe<docent_msgs::Reaction>(topics::kReaction, [this](const auto& step) { steps.push_back(step); });
  }
  void order_visit(const std::string& id, const std::string& language = "de") {
    docent_msgs::Task task;
    task.id = id;
    task.kind = "visit";
    task.exhibit_id = "vase";
    task.x = 3.0;
    task.y = 4.0;
    task.theta = 1.5;
    task.language = language;
    tasks.publish(task);
    run(0.01);
  }
  void plan_says(const std::string& id, const std::string& what, double blocked_s = 0.0) {
    docent_msgs::GoalState state_of_goal;
    state_of_goal.id = id;
    state_of_goal.state = what;
    state_of_goal.blocked_s = blocked_s;
    state_of_goal.detour = "none";
    plan.publish(state_of_goal);
    run(0.01);
  }
  void sound_says(const std::string& what) {
    speech.publish({{}, line.id, what, line.text, line.language, to_message(hub.now()), 2.0, ""});
    run(0.01);
  }

  transport::Publisher<docent_msgs::Task> tasks = world->publisher(topics::kTask);
  transport::Publisher<docent_msgs::GoalState> plan = world->publisher(topics::kGoalState);
  transport::Publisher<docent_msgs::SpeechState> speech = world->publisher(topics::kSpeechState);
  transport::Publisher<docent_msgs::AvoidState> avoid = world->publisher(topics::kAvoidState);
  docent_msgs::DriveGoal goal;
  docent_msgs::Say line;
  docent_msgs::TaskState progress;
  docent_msgs::Horn horn;
  std::vector<docent_msgs::Reaction> steps;
  int goals = 0, lines = 0, reports = 0, horns = 0;
};

TEST_F(ExecutiveModule, DrivesToTheTasksPlaceAndTellsTheExhibitsTextInTheTasksLanguage) {
  start();
  run(0.01);
  ASSERT_EQ(goals, 1);
  EXPECT_EQ(goal.id, "") << "it stays until it is told";
  order_visit("t1");
  ASSERT_EQ(goals, 2);
  EXPECT_EQ(goal.x, 3.0);
  EXPECT_EQ(goal.y, 4.0);
  EXPECT_NEAR(goal.theta, 1.5, 1e-9);
  EXPECT_FALSE(goal.relocalize);
  EXPECT_EQ(progress.state, "driving");
  order_visit("t1");
  EXPECT_EQ(goals, 2) << "the same task again is no other task";
  const int on_the_way = lines;
  plan_says("an older goal", "arrived");
  EXPECT_EQ(lines, on_the_way) << "what was said of another goal does not matter";
  plan_says(goal.id, "arrived");
  ASSERT_GT(lines, on_the_way);
  EXPECT_NE(line.text.find("Sie ist alt."), std::string::npos) << line.text;
  EXPECT_EQ(line.language, "de");
  EXPECT_EQ(progress.state, "explaining");
  sound_says("speaking");
  EXPECT_EQ(progress.state, "explaining");
  sound_says("done");
  run(1.0);
  EXPECT_EQ(progress.id, "t1");
  EXPECT_EQ(progress.state, "done") << "there is no more to tell";
}

TEST_F(ExecutiveModule, ANewProcessGoesOnInTheMiddleOfAnExplanation) {
  start();
  order_visit("t1", "en");
  plan_says(goal.id, "arrived");
  sound_says("speaking");
  const std::string told = line.id;
  kill();
  plan_says("", "idle");
  start();
  run(1.5);
  EXPECT_EQ(progress.id, "t1");
  EXPECT_EQ(progress.state, "explaining");
  EXPECT_EQ(line.id, told) << "the same line: who has begun it says it once";
  sound_says("done");
  run(1.0);
  EXPECT_EQ(progress.state, "done");
}

TEST_F(ExecutiveModule, AStepInAnotherMapIsForgotten) {
  start();
  order_visit("t1", "en");
  plan_says(goal.id, "arrived");
  ASSERT_EQ(progress.state, "explaining");
  kill();
  plan_says("", "idle");
  museum.map.cells[0] = 100;
  start();
  run(0.01);
  EXPECT_EQ(progress.state, "driving") << "the task begins again";
  EXPECT_EQ(module->health().state, "ready");
}

TEST_F(ExecutiveModule, ADamagedCheckpointIsNamedAndOutlivedByTheNext) {
  std::ofstream{state / "executive.json"} << "{\"map\": ";
  start();
  EXPECT_EQ(module->health().state, "degraded");
  EXPECT_NE(module->health().reason.find("executive.json"), std::string::npos);
  order_visit("t1");
  EXPECT_EQ(progress.state, "driving");
  EXPECT_EQ(module->health().state, "ready") << "a new one was written";
}

TEST_F(ExecutiveModule, SoundsTheHornBeforePeopleAndNotBeforeWhatTheMapHolds) {
  start();
  order_visit("t1");
  EXPECT_EQ(horns, 1) << "it departs";
  docent_msgs::AvoidState before;
  before.path_blocked = true;
  before.reason = "person_in_way";
  const auto stand_before = [&](bool unmapped, double duration) {
    before.unmapped_obstacle = unmapped;
    for (double stood = 0.0; stood < duration; stood += 0.2) {
      avoid.publish(before);
      plan_says(goal.id, "driving", stood);
      run(0.19);
    }
  };
  stand_before(false, 3.5);
  EXPECT_EQ(horns, 1);
  plan_says(goal.id, "driving");
  steps.clear();
  stand_before(true, 3.5);
  EXPECT_EQ(horns, 2);
  EXPECT_EQ(horn.reason, "person_in_way");
  const auto step = std::find_if(steps.begin(), steps.end(), [](const auto& taken) { return taken.step == "horn"; });
  ASSERT_NE(step, steps.end()) << "the page and the report hear of it";
  EXPECT_EQ(step->goal_id, goal.id);
  EXPECT_EQ(step->count, 1);
}

/// The same with a base that docks by itself, which the test is.
class ExecutiveOfADockingBase : public ExecutiveModule {
 protected:
  ExecutiveOfADockingBase() {
    EXPECT_TRUE(config.set("executive.docking.by_action=true"));
    world->subscribe<irobot_create_msgs::SendDockGoal>(topics::kSendDock, [this](const auto& wish) {
      ++docks;
      goal_id = wish.goal_id;
    });
    world->subscribe<irobot_create_msgs::SendUndockGoal>(topics::kSendUndock, [this](const auto& wish) {
      ++undocks;
      goal_id = wish.goal_id;
    });
  }
  void dock_says(bool is_docked) {
    dock.publish({{}, true, is_docked});
    run(0.3);
  }
  void action_says(const transport::Publisher<action_msgs::GoalStatusArray>& action, std::int8_t status) {
    action.publish({{{{{goal_id}, {}}, status}}});
    run(0.3);
  }
  void order_charge(const std::string& id) {
    docent_msgs::Task task;
    task.id = id;
    task.kind = "charge";
    task.x = 7.0;
    task.language = "en";
    tasks.publish(task);
    run(0.3);
  }
  transport::Publisher<irobot_create_msgs::DockStatus> dock = world->publisher(topics::kDockStatus);
  transport::Publisher<action_msgs::GoalStatusArray> docking = world->publisher(topics::kDockGoals);
  transport::Publisher<action_msgs::GoalStatusArray> undocking = world->publisher(topics::kUndockGoals);
  std::array<std::uint8_t, 16> goal_id{};
  int docks = 0, undocks = 0;
};

TEST_F(ExecutiveOfADockingBase, LeavesItsDockBeforeItDrives) {
  start();
  dock_says(true);
  run(3.0);
  EXPECT_EQ(undocks, 0) << "nobody wants it elsewhere";
  order_visit("t1");
  run(0.5);
  EXPECT_EQ(undocks, 1);
  EXPECT_EQ(goal.id, "") << "the goal waits";
  action_says(undocking, action_msgs::GoalStatus::kExecuting);
  dock_says(false);
  EXPECT_EQ(goal.id, "") << "the base still moves by itself";
  action_says(undocking, action_msgs::GoalStatus::kSucceeded);
  EXPECT_EQ(goal.id.substr(0, 3), "t1/");
  EXPECT_EQ(goal.x, 3.0);
}

TEST_F(ExecutiveOfADockingBase, DocksWhereItsChargerIsAndStaysThere) {
  start();
  dock_says(false);
  order_charge("c1");
  EXPECT_EQ(goal.x, 7.0);
  EXPECT_EQ(docks, 0) << "not from here";
  plan_says(goal.id, "arrived");
  run(0.5);
  EXPECT_EQ(docks, 1);
  action_says(docking, action_msgs::GoalStatus::kExecuting);
  EXPECT_EQ(goal.id, "") << "the base moves by itself";
  run(20.0);
  EXPECT_EQ(progress.state, "driving") << "it takes its time";
  dock_says(true);
  action_says(docking, action_msgs::GoalStatus::kSucceeded);
  run(1.0);
  EXPECT_EQ(progress.state, "done");
  run(60.0);
  EXPECT_EQ(docks, 1);
  EXPECT_EQ(undocks, 0);
  EXPECT_EQ(goal.id, "") << "it is not driven back to the place before its dock";
}

TEST_F(ExecutiveOfADockingBase, WhoStandsInItsDockAlreadyCharges) {
  start();
  dock_says(true);
  order_charge("c1");
  run(2.0);
  EXPECT_EQ(progress.state, "done");
  EXPECT_EQ(undocks + docks, 0);
}

TEST_F(ExecutiveOfADockingBase, ABaseThatSaysNothingOfItsDockIsNotDriven) {
  start();
  order_visit("t1");
  run(5.0);
  EXPECT_EQ(goal.id, "");
  EXPECT_EQ(module->health().reason, "the base says nothing of its dock (dock_status)");
}

}  // namespace
}  // namespace docent::modules
