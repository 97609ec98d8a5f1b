#include "navigator_node.h"

#include <gtest/gtest.h>

#include <cmath>

// The whole node against a stand-in for rclcpp (stubs/), with a robot that keeps a board as Docent's mission does.

namespace docent_ros {
namespace {

using geometry_msgs::msg::PoseStamped;
using geometry_msgs::msg::PoseWithCovarianceStamped;
using nav2_msgs::action::NavigateThroughPoses;
using nav2_msgs::action::NavigateToPose;
using Return = NavigatorNode::CallbackReturn;
using Status = rclcpp_action::ServerGoalHandle<NavigateToPose>::Status;
constexpr rclcpp_action::GoalUUID kFirst{1};
constexpr rclcpp_action::GoalUUID kSecond{2};

PoseStamped pose_at(double x, double y, double yaw = 0.0) {
  PoseStamped pose;
  pose.header.frame_id = "map";
  pose.pose.position.x = x;
  pose.pose.position.y = y;
  pose.pose.orientation.z = std::sin(0.5 * yaw);
  pose.pose.orientation.w = std::cos(0.5 * yaw);
  return pose;
}

class Node : public testing::Test {
 protected:
  Node() { rclcpp::World::get() = {}; }
  void make(std::map<std::string, rclcpp::ParameterValue> parameters = {}) {
    const auto space = parameters.find("__ns");
    prefix = space == parameters.end() ? "" : std::get<std::string>(space->second);
    node = std::make_shared<NavigatorNode>(rclcpp::NodeOptions().parameter_overrides(std::move(parameters)));
    robot = std::make_shared<rclcpp_lifecycle::LifecycleNode>("robot");
    requests = robot->create_subscription<docent_msgs::msg::Request>(
        prefix + "/docent/request", rclcpp::QoS(32), [this](const docent_msgs::msg::Request& r) { take(r); });
    said = robot->create_subscription<PoseWithCovarianceStamped>(
        prefix + "/initialpose", rclcpp::QoS(1), [this](const PoseWithCovarianceStamped& p) { poses.push_back(p); });
  }
  void start(std::map<std::string, rclcpp::ParameterValue> parameters = {}) {
    make(std::move(parameters));
    ASSERT_EQ(node->on_configure({}), Return::SUCCESS);
    ASSERT_EQ(node->on_activate({}), Return::SUCCESS);
  }
  /// As the mission.
  void take(const docent_msgs::msg::Request& request) {
    heard.push_back(request);
    for (const auto& entry : board.requests)
      if (entry.request.id == request.id) return;
    docent_msgs::msg::RequestState entry;
    entry.request = request;
    entry.state = request.kind == "cancel" ? "fulfilled" : "queued";
    for (auto& other : board.requests)
      if (request.kind == "cancel" && other.request.id == request.target) other.state = "cancelled";
    board.requests.push_back(entry);
    is_board_new = true;
  }
  void set(const std::string& state, const std::string& reason = {}) {
    for (auto& entry : board.requests) {
      if (entry.request.kind != "point" || (entry.state != "queued" && entry.state != "active")) continue;
      entry.state = state;
      entry.reason = reason;
    }
    is_board_new = true;
  }
  void pass(double seconds) {
    auto& world = rclcpp::World::get();
    const std::int64_t end = world.now + static_cast<std::int64_t>(seconds * 1e9);
    while (world.now < end) {
      world.run_until(std::min(end, world.now + 100'000'000));
      docent_msgs::msg::GoalState state;
      state.state = "driving";
      state.remaining_m = 4.0;
      if (speaks) world.send(prefix + "/docent/goal_state", state, true);
      if (std::exchange(is_board_new, false)) world.send(prefix + "/docent/request_board", board, true);
    }
  }
  template <class Action>
  [[nodiscard]] std::shared_ptr<rclcpp_action::Server<Action>> server(const std::string& name) {
    return std::any_cast<std::weak_ptr<rclcpp_action::Server<Action>>>(rclcpp::World::get().actions[prefix + name])
        .lock();
  }
  auto drive_to(const rclcpp_action::GoalUUID& id, const PoseStamped& pose, const std::string& tree = {}) {
    NavigateToPose::Goal goal;
    goal.pose = pose;
    goal.behavior_tree = tree;
    return server<NavigateToPose>("/navigate_to_pose")->send_goal(id, goal);
  }
  [[nodiscard]] std::string last_log() const { return node->get_logger().lines->back(); }

  std::shared_ptr<NavigatorNode> node;
  std::shared_ptr<rclcpp_lifecycle::LifecycleNode> robot;
  rclcpp::Subscription<docent_msgs::msg::Request>::SharedPtr requests;
  rclcpp::Subscription<PoseWithCovarianceStamped>::SharedPtr said;
  std::vector<docent_msgs::msg::Request> heard;
  std::vector<PoseWithCovarianceStamped> poses;
  docent_msgs::msg::RequestBoard board;
  std::string prefix;
  bool is_board_new = false;
  bool speaks = true;
};

TEST_F(Node, ServesAGoalByARequestOfTheStaff) {
  start();
  const auto handle = drive_to(kFirst, pose_at(3.0, 4.0, 1.5));
  ASSERT_TRUE(handle);
  ASSERT_EQ(heard.size(), 1U);
  EXPECT_EQ(heard[0].kind, "point");
  EXPECT_EQ(heard[0].source, "staff");
  EXPECT_EQ(heard[0].visitor, "ROS");
  EXPECT_EQ(heard[0].target, "3.00,4.00,1.500");
  pass(1.0);
  set("active");
  PoseWithCovarianceStamped here;
  here.pose.pose = pose_at(1.0, 1.0, -0.5).pose;
  rclcpp::World::get().send("/amcl_pose", here, true);
  pass(1.0);
  ASSERT_TRUE(handle->feedback);
  EXPECT_FLOAT_EQ(handle->feedback->distance_remaining, 4.0F);
  EXPECT_EQ(handle->feedback->navigation_time.sec, 2);
  EXPECT_EQ(handle->feedback->estimated_time_remaining.sec, 8) << "at 0.5 m/s";
  EXPECT_EQ(handle->feedback->current_pose.header.frame_id, "map");
  EXPECT_DOUBLE_EQ(handle->feedback->current_pose.pose.position.x, 1.0);
  EXPECT_NEAR(handle->feedback->current_pose.pose.orientation.z, std::sin(-0.25), 1e-9);
  set("fulfilled");
  pass(0.5);
  EXPECT_EQ(handle->status, Status::succeeded);
  EXPECT_EQ(handle->result->error_code, 0);
}

TEST_F(Node, GoesThroughPosesOneAfterTheOther) {
  start();
  NavigateThroughPoses::Goal goal;
  goal.poses = {pose_at(1.0, 0.0, 3.0), pose_at(2.0, 0.0, 3.0)};
  const auto handle = server<NavigateThroughPoses>("/navigate_through_poses")->send_goal(kFirst, goal);
  ASSERT_TRUE(handle);
  pass(0.5);
  EXPECT_EQ(handle->feedback->number_of_poses_remaining, 2);
  set("fulfilled");
  pass(0.5);
  ASSERT_EQ(heard.size(), 2U);
  EXPECT_EQ(heard[0].target, "1.00,0.00");
  EXPECT_EQ(heard[1].target, "2.00,0.00,3.000");
  EXPECT_EQ(handle->feedback->number_of_poses_remaining, 1);
  EXPECT_TRUE(handle->is_executing());
  set("fulfilled");
  pass(0.5);
  EXPECT_FALSE(handle->is_active());
}

TEST_F(Node, ANewerGoalOfEitherActionAbortsTheOneUnderWay) {
  start();
  const auto first = drive_to(kFirst, pose_at(3.0, 4.0));
  pass(0.5);
  NavigateThroughPoses::Goal goal;
  goal.poses = {pose_at(1.0, 0.0)};
  const auto second = server<NavigateThroughPoses>("/navigate_through_poses")->send_goal(kSecond, goal);
  EXPECT_EQ(first->status, Status::aborted);
  EXPECT_EQ(first->result->error_msg, "replaced");
  EXPECT_TRUE(second->is_executing());
  ASSERT_EQ(heard.size(), 3U);
  EXPECT_EQ(heard[1].kind, "cancel");
  EXPECT_EQ(heard[1].target, heard[0].id);
}

TEST_F(Node, CancelsWhenTheRobotSaysSo) {
  start();
  const auto handle = drive_to(kFirst, pose_at(3.0, 4.0));
  pass(0.5);
  EXPECT_TRUE(server<NavigateToPose>("/navigate_to_pose")->cancel(handle));
  EXPECT_TRUE(handle->is_canceling());
  pass(0.5);
  EXPECT_EQ(handle->status, Status::canceled);
  EXPECT_EQ(board.requests[0].state, "cancelled");
  EXPECT_FALSE(server<NavigateToPose>("/navigate_to_pose")->cancel(handle)) << "it is over";
}

TEST_F(Node, AbortsWithNav2sErrorCodes) {
  start();
  const auto refused = drive_to(kFirst, pose_at(3.0, 4.0));
  set("refused", "not_on_free_floor");
  pass(0.5);
  EXPECT_EQ(refused->status, Status::aborted);
  EXPECT_EQ(refused->result->error_code, 206);
  EXPECT_EQ(refused->result->error_msg, "not_on_free_floor");
  const auto failed = drive_to(kSecond, pose_at(5.0, 4.0));
  pass(0.5);
  set("failed", "way_blocked");
  pass(0.5);
  EXPECT_EQ(failed->result->error_code, 105);
}

TEST_F(Node, ARobotThatIsNotThereIsATimeout) {
  start();
  requests.reset();
  speaks = false;
  const auto handle = drive_to(kFirst, pose_at(3.0, 4.0));
  pass(4.0);
  EXPECT_TRUE(handle->is_executing());
  pass(1.5);
  EXPECT_EQ(handle->status, Status::aborted);
  EXPECT_EQ(handle->result->error_code, 9003);
}

TEST_F(Node, RefusesWhatItCannotDo) {
  start();
  auto elsewhere = pose_at(1.0, 1.0);
  elsewhere.header.frame_id = "odom";
  EXPECT_FALSE(drive_to(kFirst, elsewhere));
  EXPECT_EQ(last_log(), "warn navigate_to_pose: refused: a pose is in frame 'odom'; it must be 'map'");
  auto empty = pose_at(1.0, 1.0);
  empty.pose.orientation.w = 0.0;
  EXPECT_FALSE(drive_to(kFirst, empty));
  EXPECT_FALSE(drive_to(kFirst, pose_at(std::nan(""), 1.0)));
  EXPECT_FALSE(drive_to(kFirst, pose_at(1.0, 1.0), "my_tree.xml"));
  EXPECT_EQ(last_log(), "warn navigate_to_pose: refused: Docent has no behavior trees");
  EXPECT_FALSE(server<NavigateThroughPoses>("/navigate_through_poses")->send_goal(kFirst, {})) << "no pose";
  EXPECT_TRUE(heard.empty());
}

TEST_F(Node, FollowsItsLifecycle) {
  make();
  ASSERT_EQ(node->on_configure({}), Return::SUCCESS);
  EXPECT_FALSE(drive_to(kFirst, pose_at(1.0, 1.0))) << "it is not active yet";
  ASSERT_EQ(node->on_activate({}), Return::SUCCESS);
  const auto handle = drive_to(kFirst, pose_at(1.0, 1.0));
  ASSERT_TRUE(handle);
  ASSERT_EQ(node->on_deactivate({}), Return::SUCCESS);
  EXPECT_EQ(handle->status, Status::aborted);
  EXPECT_EQ(handle->result->error_msg, "deactivated");
  EXPECT_EQ(board.requests[0].state, "cancelled") << "the robot was told";
  pass(1.0);
  ASSERT_EQ(node->on_cleanup({}), Return::SUCCESS);
  EXPECT_FALSE(server<NavigateToPose>("/navigate_to_pose"));
  ASSERT_EQ(node->on_configure({}), Return::SUCCESS) << "once more";
  ASSERT_EQ(node->on_activate({}), Return::SUCCESS);
  EXPECT_TRUE(drive_to(kSecond, pose_at(1.0, 1.0)));
  EXPECT_EQ(node->on_shutdown({}), Return::SUCCESS);
  EXPECT_EQ(heard.back().kind, "cancel");
}

TEST_F(Node, NamesAParameterThatIsWrong) {
  make({{"speed", -1.0}});
  EXPECT_EQ(node->on_configure({}), Return::FAILURE);
  EXPECT_EQ(last_log(), "error parameter speed must be > 0");
}

TEST_F(Node, HandsInitialPosesOnIntoItsNamespace) {
  start({{"__ns", std::string("/minerva")}});
  auto& world = rclcpp::World::get();
  PoseWithCovarianceStamped pose;
  pose.header.frame_id = "map";
  pose.header.stamp.sec = 7;
  world.send("/initialpose", pose, false);
  ASSERT_EQ(poses.size(), 1U);
  EXPECT_EQ(poses[0].header.stamp.sec, 7);
  pose.header.frame_id = "odom";
  world.send("/initialpose", pose, false);
  EXPECT_EQ(poses.size(), 1U);
  EXPECT_EQ(last_log(), "warn a pose in frame 'odom' was said; it must be 'map'");
}

TEST_F(Node, OfASimulatedClockAPoseIsOfNow) {
  start({{"__ns", std::string("/minerva")}, {"use_sim_time", true}});
  PoseWithCovarianceStamped pose;
  pose.header.frame_id = "map";
  pose.header.stamp.sec = 7;
  rclcpp::World::get().send("/initialpose", pose, false);
  ASSERT_EQ(poses.size(), 1U);
  EXPECT_EQ(poses[0].header.stamp.sec, 0);
}

TEST_F(Node, HandsNothingOnToItself) {
  start();
  PoseWithCovarianceStamped pose;
  pose.header.frame_id = "map";
  rclcpp::World::get().send("/initialpose", pose, false);
  EXPECT_EQ(poses.size(), 1U) << "Docent hears it without the node";
}

}  // namespace
}  // namespace docent_ros
