#pragma once

#include <docent_msgs/msg/goal_state.hpp>
#include <docent_msgs/msg/request.hpp>
#include <docent_msgs/msg/request_board.hpp>
#include <geometry_msgs/msg/pose_with_covariance_stamped.hpp>
#include <map>
#include <memory>
#include <nav2_msgs/action/navigate_through_poses.hpp>
#include <nav2_msgs/action/navigate_to_pose.hpp>
#include <rclcpp/rclcpp.hpp>
#include <rclcpp_action/rclcpp_action.hpp>
#include <rclcpp_lifecycle/lifecycle_node.hpp>
#include <string>
#include <variant>
#include <vector>

#include "docent/task_control/navigation_goals/navigation_goals.h"

namespace docent_ros {

/// Serves navigate_to_pose and navigate_through_poses by requests to Docent's mission, and hands /initialpose on. A
/// coat round docent::task_control::NavigationGoals, which decides everything; for a single-threaded executor.
class NavigatorNode : public rclcpp_lifecycle::LifecycleNode {
 public:
  explicit NavigatorNode(const rclcpp::NodeOptions& options = rclcpp::NodeOptions());

  CallbackReturn on_configure(const rclcpp_lifecycle::State& before) override;
  CallbackReturn on_activate(const rclcpp_lifecycle::State& before) override;
  CallbackReturn on_deactivate(const rclcpp_lifecycle::State& before) override;
  CallbackReturn on_cleanup(const rclcpp_lifecycle::State& before) override;
  CallbackReturn on_shutdown(const rclcpp_lifecycle::State& before) override;

 private:
  using ToPose = nav2_msgs::action::NavigateToPose;
  using ThroughPoses = nav2_msgs::action::NavigateThroughPoses;
  using Goals = docent::task_control::NavigationGoals;
  template <class Action>
  using Handle = std::shared_ptr<rclcpp_action::ServerGoalHandle<Action>>;
  using AnyHandle = std::variant<Handle<ToPose>, Handle<ThroughPoses>>;

  template <class Action>
  [[nodiscard]] typename rclcpp_action::Server<Action>::SharedPtr serve(const std::string& name);
  /// Error: why not, in English.
  [[nodiscard]] std::string read(const std::vector<geometry_msgs::msg::PoseStamped>& poses,
                                 docent::task_control::NavigationGoal& goal) const;
  void subscribe();
  void hand_on(const geometry_msgs::msg::PoseWithCovarianceStamped& pose);
  void step();
  /// Tells the robot and the clients what there is to tell.
  void flush();
  void finish(const docent::task_control::GoalEnd& end);
  template <class Action>
  void feed_back(const Handle<Action>& handle, const docent::task_control::GoalProgress& progress) const;
  void release();
  [[nodiscard]] docent::Time clock();

  std::string frame_;
  std::string visitor_;
  bool is_active_ = false;
  std::unique_ptr<Goals> goals_;
  std::map<docent::task_control::GoalId, AnyHandle> handles_;  ///< of goals that have not ended

  rclcpp_lifecycle::LifecyclePublisher<docent_msgs::msg::Request>::SharedPtr requests_;
  rclcpp_lifecycle::LifecyclePublisher<geometry_msgs::msg::PoseWithCovarianceStamped>::SharedPtr initial_pose_;
  rclcpp::Subscription<docent_msgs::msg::RequestBoard>::SharedPtr board_;
  rclcpp::Subscription<docent_msgs::msg::GoalState>::SharedPtr goal_state_;
  rclcpp::Subscription<geometry_msgs::msg::PoseWithCovarianceStamped>::SharedPtr pose_, said_pose_;
  rclcpp_action::Server<ToPose>::SharedPtr to_pose_;
  rclcpp_action::Server<ThroughPoses>::SharedPtr through_poses_;
  rclcpp::TimerBase::SharedPtr timer_;
};

}  // namespace docent_ros
