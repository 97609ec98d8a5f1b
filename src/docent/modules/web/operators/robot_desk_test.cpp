#include "docent/modules/web/operators/robot_desk.h"

#include <gtest/gtest.h>

#include <thread>

#include "docent/messages/topics.h"
#include "docent/transport/virtual_time_bus.h"

namespace docent::modules {
namespace {

constexpr const char* kGoal = "01900000-0000-7000-8000-000000000001";

class ARobotDesk : public testing::Test {
 protected:
  ARobotDesk() {
    robot_->subscribe<docent_msgs::Request>(topics::kRequest,
                                            [this](const auto& request) { heard_.push_back(request); });
  }
  void pass(double duration_s) { hub_.run_until(hub_.now() + seconds(duration_s)); }
  /// As the desk of /api/v1 does, from its thread.
  template <class F>
  void ask(F&& what) {
    std::thread{[&] { what(*desk_.office()); }}.join();
    pass(0.1);
  }
  [[nodiscard]] telepresence::documents::RobotState state() const { return desk_.office()->state(); }

  transport::VirtualTimeHub hub_;
  std::unique_ptr<transport::Bus> robot_ = hub_.connect("robot");
  std::unique_ptr<transport::Bus> bus_ = hub_.connect("web");
  RobotDesk desk_{*bus_};
  std::vector<docent_msgs::Request> heard_;
};

TEST_F(ARobotDesk, SendsTheRobotByARequestOfTheStaff) {
  ask([](const auto& office) { office.drive({kGoal, 3.0, -4.5, 1.5}); });
  ASSERT_EQ(heard_.size(), 1U);
  EXPECT_EQ(heard_[0].id, kGoal);
  EXPECT_EQ(heard_[0].kind, "point");
  EXPECT_EQ(heard_[0].source, "staff");
  EXPECT_EQ(heard_[0].target, "3.00,-4.50,1.500");
  ask([](const auto& office) { office.cancel(kGoal); });
  ask([](const auto& office) { office.cancel(kGoal); });
  ASSERT_EQ(heard_.size(), 3U);
  EXPECT_EQ(heard_[1].kind, "cancel");
  EXPECT_EQ(heard_[1].target, kGoal);
  EXPECT_EQ(heard_[1].id, heard_[2].id) << "said twice it is the same withdrawal";
}

TEST_F(ARobotDesk, GivesAnOfficesOrdersOnAndTellsHowTheyGo) {
  std::vector<docent_msgs::OfficeOrder> orders;
  robot_->subscribe<docent_msgs::OfficeOrder>(topics::kOfficeOrder,
                                              [&](const auto& order) { orders.push_back(order); });
  ask([](const auto& office) { office.order({kGoal, "deliver", "kitchen"}); });
  ASSERT_EQ(orders.size(), 1U);
  EXPECT_EQ(orders[0].id, kGoal);
  EXPECT_EQ(orders[0].kind, "deliver");
  EXPECT_EQ(orders[0].room, "kitchen");
  EXPECT_EQ(orders[0].source, "staff");
  EXPECT_EQ(desk_.office()->report().phase, "");
  docent_msgs::OfficeState told;
  told.order = kGoal, told.phase = "asking", told.found = 2, told.in_bin = 1;
  robot_->publisher(topics::kOfficeState).publish(told);
  pass(0.1);
  EXPECT_EQ(desk_.office()->report().phase, "asking");
  EXPECT_EQ(desk_.office()->report().found, 2);
}

TEST_F(ARobotDesk, TellsHowTheRobotIs) {
  EXPECT_FALSE(state().pose);
  EXPECT_FALSE(state().battery);
  docent_msgs::RequestBoard board;
  board.requests.resize(3);
  board.requests[0].request = {kGoal, {}, "staff", "", "point", "3.00,4.00,1.50", -1, "en"};
  board.requests[0].state = "failed";
  board.requests[0].reason = "way_blocked";
  board.requests[1].request = {"visitor", {}, "web", "", "point", "3.00,4.00", -1, "en"};
  board.requests[1].state = "queued";
  board.requests[2].request = {"unknown", {}, "staff", "", "point", "3.00,4.00", -1, "en"};
  board.requests[2].state = "a word of tomorrow";
  robot_->publisher(topics::kRequestBoard).publish(board);
  docent_msgs::MissionState mission;
  mission.phase = "driving";
  robot_->publisher(topics::kMissionState).publish(mission);
  docent_msgs::GoalState goal;
  goal.id = "task/drive";
  goal.remaining_m = 7.5;
  robot_->publisher(topics::kGoalState).publish(goal);
  sensor_msgs::BatteryState battery;
  battery.percentage = 0.25F;
  battery.power_supply_status = 1;
  robot_->publisher(topics::kBattery).publish(battery);
  pass(0.1);
  desk_.see(Pose2{1.0, 2.0, Angle::radians(0.5)});
  telepresence::documents::OperationMessage operation;
  operation.is_stopped = true;
  desk_.see(operation);
  const auto now = state();
  ASSERT_EQ(now.goals.size(), 1U) << "only those of the staff, and nothing that is not understood";
  EXPECT_EQ(now.goals[0].id, kGoal);
  EXPECT_EQ(now.goals[0].state, RequestStatus::failed);
  EXPECT_EQ(now.goals[0].reason, "way_blocked");
  EXPECT_EQ(now.phase, "driving");
  EXPECT_DOUBLE_EQ(now.remaining_m, 7.5);
  EXPECT_DOUBLE_EQ(now.battery.value(), 0.25);
  EXPECT_TRUE(now.is_charging);
  EXPECT_TRUE(now.is_stopped);
  EXPECT_EQ(now.pose, (std::array{1.0, 2.0, 0.5}));
  EXPECT_GT(now.t, 0.0);
  desk_.see(std::nullopt);
  EXPECT_FALSE(state().pose) << "it does not know its place any more";
}

}  // namespace
}  // namespace docent::modules
