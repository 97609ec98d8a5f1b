#include "docent/modules/guide/dock_client.h"

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <vector>

#include "docent/transport/create3_support.h"
#include "docent/transport/virtual_time_bus.h"

namespace docent::modules {
namespace {

using action_msgs::GoalStatus;
using Wish = DockClient::Wish;

/// The client on one bus; the test is the base on another.
class DockClientTest : public ::testing::Test {
 protected:
  DockClientTest() {
    base->subscribe<irobot_create_msgs::SendDockGoal>(topics::kSendDock, [this](const auto& goal) {
      EXPECT_EQ(goal.request_id, goal.goal_id);
      docks.push_back(goal.goal_id);
    });
    base->subscribe<irobot_create_msgs::SendUndockGoal>(topics::kSendUndock,
                                                        [this](const auto& goal) { undocks.push_back(goal.goal_id); });
    bus->every(std::chrono::milliseconds{250}, [this] { client.tick(); });
  }
  void offer() {
    dock_goals = base->publisher(topics::kDockGoals);
    undock_goals = base->publisher(topics::kUndockGoals);
  }
  void run(double duration) { hub.run_until(hub.now() + seconds(duration)); }
  void say_docked(bool is_docked) {
    dock.publish({{}, true, is_docked});
    run(0.01);
  }
  void say(transport::Publisher<action_msgs::GoalStatusArray>& on, const std::array<std::uint8_t, 16>& id,
           std::int8_t status) {
    // Behind a goal of somebody else, whose fate is none of ours.
    action_msgs::GoalStatusArray goals;
    goals.status_list.push_back({{{{9, 9, 9}}, {}}, GoalStatus::kAborted});
    goals.status_list.push_back({{{id}, {}}, status});
    on.publish(goals);
    run(0.01);
  }

  transport::VirtualTimeHub hub;
  std::unique_ptr<transport::Bus> bus = hub.connect("executive");
  std::unique_ptr<transport::Bus> base = hub.connect("base");
  transport::Publisher<irobot_create_msgs::DockStatus> dock = base->publisher(topics::kDockStatus);
  transport::Publisher<action_msgs::GoalStatusArray> dock_goals, undock_goals;
  DockClient client{*bus};
  std::vector<std::array<std::uint8_t, 16>> docks, undocks;
};

TEST_F(DockClientTest, DocksOnceAndIsContent) {
  offer();
  say_docked(false);
  client.want(Wish::docked);
  run(0.5);
  ASSERT_EQ(docks.size(), 1U);
  EXPECT_TRUE(client.is_moving());
  say(dock_goals, docks[0], GoalStatus::kExecuting);
  run(20.0);
  EXPECT_EQ(docks.size(), 1U) << "it takes its time";
  say_docked(true);
  say(dock_goals, docks[0], GoalStatus::kSucceeded);
  run(20.0);
  EXPECT_TRUE(client.is_docked());
  EXPECT_FALSE(client.is_moving());
  EXPECT_EQ(client.complaint(), "");
  client.want(Wish::free);
  run(0.5);
  ASSERT_EQ(undocks.size(), 1U);
  EXPECT_NE(undocks[0], docks[0]);
  EXPECT_EQ(docks.size(), 1U);
}

TEST_F(DockClientTest, WhatIsFulfilledAlreadyIsNotAskedFor) {
  offer();
  say_docked(true);
  client.want(Wish::docked);
  run(10.0);
  EXPECT_TRUE(docks.empty()) << "the action would fail";
  client.want(Wish::none);
  run(10.0);
  EXPECT_TRUE(undocks.empty());
}

TEST_F(DockClientTest, ABaseWithoutTheActionIsNamed) {
  say_docked(false);
  client.want(Wish::docked);
  run(1.0);
  EXPECT_EQ(client.complaint(), "the base offers no action /dock");
  EXPECT_TRUE(docks.empty());
  EXPECT_FALSE(client.is_moving());
  offer();
  run(6.0);
  EXPECT_EQ(docks.size(), 1U) << "it has come up since";
}

TEST_F(DockClientTest, ABaseThatSaysNothingOfItsDockIsNamed) {
  offer();
  client.want(Wish::free);
  run(1.0);
  EXPECT_EQ(client.complaint(), "the base says nothing of its dock (dock_status)");
  EXPECT_TRUE(undocks.empty());
}

TEST_F(DockClientTest, AFailureIsToldAndTriedAgain) {
  offer();
  say_docked(false);
  client.want(Wish::docked);
  run(0.5);
  ASSERT_EQ(docks.size(), 1U);
  say(dock_goals, docks[0], GoalStatus::kAborted);
  EXPECT_EQ(client.complaint(), "/dock failed, says the base");
  EXPECT_FALSE(client.is_moving());
  run(6.0);
  ASSERT_EQ(docks.size(), 2U);
  EXPECT_NE(docks[0], docks[1]) << "every goal has an id of its own";
  run(4.0);  // nobody takes this one
  EXPECT_EQ(client.complaint(), "the base has not taken the goal /dock");
}

TEST_F(DockClientTest, TheStatusOfTheOtherActionMeansNothing) {
  offer();
  say_docked(false);
  client.want(Wish::docked);
  run(0.5);
  ASSERT_EQ(docks.size(), 1U);
  say(undock_goals, docks[0], GoalStatus::kAborted);
  EXPECT_TRUE(client.is_moving());
}

TEST_F(DockClientTest, AnActionWithoutAnEndIsGivenUp) {
  offer();
  say_docked(false);
  client.want(Wish::docked);
  run(0.5);
  ASSERT_EQ(docks.size(), 1U);
  say(dock_goals, docks[0], GoalStatus::kExecuting);
  run(121.0);
  EXPECT_EQ(client.complaint(), "/dock has not come to an end");
}

}  // namespace
}  // namespace docent::modules
