#include "navigator_node.h"

#include <cmath>
#include <type_traits>
#include <utility>

#include "docent/task_control/navigation_goals/error_code.h"

namespace docent_ros {
namespace {

namespace control = docent::task_control;
using geometry_msgs::msg::PoseStamped;
using geometry_msgs::msg::PoseWithCovarianceStamped;
using rclcpp_action::CancelResponse;
using rclcpp_action::GoalResponse;

constexpr double kPeriod_s = 0.2;  // of feedback
constexpr const char* kInitialPose = "initialpose";

// As Docent's own readers and writers of these topics (docs/connect-your-robot.md, classes state and command).
rclcpp::QoS state_qos() { return rclcpp::QoS(1).reliable().transient_local(); }
rclcpp::QoS command_qos() { return rclcpp::QoS(32).reliable(); }

geometry_msgs::msg::Pose to_message(const docent::Pose2& pose) {
  geometry_msgs::msg::Pose message;
  message.position.x = pose.x;
  message.position.y = pose.y;
  message.orientation.z = std::sin(0.5 * pose.theta.radians());
  message.orientation.w = std::cos(0.5 * pose.theta.radians());
  return message;
}

builtin_interfaces::msg::Duration to_duration(double value) {
  builtin_interfaces::msg::Duration message;
  const double whole = std::floor(std::min(value, 1e9));
  message.sec = static_cast<std::int32_t>(whole);
  message.nanosec = static_cast<std::uint32_t>((std::min(value, 1e9) - whole) * 1e9);
  return message;
}

std::vector<PoseStamped> poses_of(const nav2_msgs::action::NavigateToPose::Goal& goal) { return {goal.pose}; }
std::vector<PoseStamped> poses_of(const nav2_msgs::action::NavigateThroughPoses::Goal& goal) { return goal.poses; }

}  // namespace

NavigatorNode::NavigatorNode(const rclcpp::NodeOptions& options) : LifecycleNode("docent_navigator", options) {
  declare_parameter("frame", std::string("map"));
  declare_parameter("visitor", std::string("ROS"));
  declare_parameter("initial_pose_topic", std::string("/initialpose"));
  control::NavigationGoalParams defaults;
  const auto declare = [this](const char* name, auto value) { declare_parameter(name, value); };
  defaults.visit(declare);
}

NavigatorNode::CallbackReturn NavigatorNode::on_configure(const rclcpp_lifecycle::State& /*before*/) {
  control::NavigationGoalParams params;
  const auto read = [this](const char* name, auto& value) {
    if constexpr (std::is_integral_v<std::remove_reference_t<decltype(value)>>)
      value = static_cast<int>(get_parameter(name).as_int());
    else
      value = get_parameter(name).as_double();
  };
  params.visit(read);
  if (const std::string fault = params.fault(); !fault.empty()) {
    RCLCPP_ERROR(get_logger(), "parameter %s", fault.c_str());
    return CallbackReturn::FAILURE;
  }
  frame_ = get_parameter("frame").as_string();
  visitor_ = get_parameter("visitor").as_string();
  goals_ = std::make_unique<Goals>(params);
  requests_ = create_publisher<docent_msgs::msg::Request>("docent/request", command_qos());
  initial_pose_ = create_publisher<PoseWithCovarianceStamped>(kInitialPose, command_qos());
  subscribe();
  to_pose_ = serve<ToPose>("navigate_to_pose");
  through_poses_ = serve<ThroughPoses>("navigate_through_poses");
  timer_ = rclcpp::create_timer(this, get_clock(), rclcpp::Duration::from_seconds(kPeriod_s), [this] { step(); });
  return CallbackReturn::SUCCESS;
}

void NavigatorNode::subscribe() {
  board_ = create_subscription<docent_msgs::msg::RequestBoard>(
      "docent/request_board", state_qos(), [this](const docent_msgs::msg::RequestBoard& board) {
        std::vector<control::RequestNews> all;
        for (const auto& entry : board.requests) {
          const auto status = docent::parse<docent::RequestStatus>(entry.state);
          if (status) all.push_back({entry.request.id, *status, entry.reason});
        }
        goals_->board(all, clock());
        flush();
      });
  goal_state_ = create_subscription<docent_msgs::msg::GoalState>(
      "docent/goal_state", state_qos(), [this](const docent_msgs::msg::GoalState& state) {
        goals_->drive(state.remaining_m, state.blocked_s > 0.0 || state.state == "blocked", clock());
      });
  pose_ = create_subscription<PoseWithCovarianceStamped>(
      "amcl_pose", state_qos(), [this](const PoseWithCovarianceStamped& message) {
        const auto& q = message.pose.pose.orientation;
        const auto heading = control::heading_of(q.x, q.y, q.z, q.w);
        if (heading) goals_->pose({message.pose.pose.position.x, message.pose.pose.position.y, *heading});
      });
  const std::string said = get_parameter("initial_pose_topic").as_string();
  if (said.empty() || said == initial_pose_->get_topic_name()) return;  // Docent hears it without us
  said_pose_ = create_subscription<PoseWithCovarianceStamped>(
      said, command_qos(), [this](const PoseWithCovarianceStamped& pose) { hand_on(pose); });
}

void NavigatorNode::hand_on(const PoseWithCovarianceStamped& pose) {
  if (!is_active_) return;
  if (pose.header.frame_id != frame_) {
    RCLCPP_WARN(get_logger(), "a pose in frame '%s' was said; it must be '%s'", pose.header.frame_id.c_str(),
                frame_.c_str());
    return;
  }
  PoseWithCovarianceStamped handed = pose;
  // Docent's clock is the wall's: a stamp of a simulated one says nothing to it, and zero means now.
  if (get_parameter("use_sim_time").as_bool()) handed.header.stamp = builtin_interfaces::msg::Time();
  initial_pose_->publish(handed);
}

NavigatorNode::CallbackReturn NavigatorNode::on_activate(const rclcpp_lifecycle::State& before) {
  is_active_ = true;
  return LifecycleNode::on_activate(before);
}

NavigatorNode::CallbackReturn NavigatorNode::on_deactivate(const rclcpp_lifecycle::State& before) {
  goals_->deactivate(clock());
  flush();  // while there still is somebody to tell
  is_active_ = false;
  return LifecycleNode::on_deactivate(before);
}

NavigatorNode::CallbackReturn NavigatorNode::on_cleanup(const rclcpp_lifecycle::State& /*before*/) {
  release();
  return CallbackReturn::SUCCESS;
}

NavigatorNode::CallbackReturn NavigatorNode::on_shutdown(const rclcpp_lifecycle::State& /*before*/) {
  if (is_active_) {
    goals_->deactivate(clock());
    flush();
  }
  release();
  return CallbackReturn::SUCCESS;
}

void NavigatorNode::release() {
  is_active_ = false;
  timer_.reset();
  to_pose_.reset();
  through_poses_.reset();
  board_.reset();
  goal_state_.reset();
  pose_.reset();
  said_pose_.reset();
  requests_.reset();
  initial_pose_.reset();
  handles_.clear();
  goals_.reset();
}

docent::Time NavigatorNode::clock() { return docent::Time{now().nanoseconds()}; }

std::string NavigatorNode::read(const std::vector<PoseStamped>& poses, control::NavigationGoal& goal) const {
  for (const PoseStamped& pose : poses) {
    if (pose.header.frame_id != frame_)
      return "a pose is in frame '" + pose.header.frame_id + "'; it must be '" + frame_ + "'";
    const auto& q = pose.pose.orientation;
    const auto heading = control::heading_of(q.x, q.y, q.z, q.w);
    if (!heading) return "an orientation is no rotation";
    goal.map_from_base.push_back({pose.pose.position.x, pose.pose.position.y, *heading});
  }
  return goals_->refusal(goal);
}

template <class Action>
typename rclcpp_action::Server<Action>::SharedPtr NavigatorNode::serve(const std::string& name) {
  const auto take = [this, name](const rclcpp_action::GoalUUID& id, std::shared_ptr<const typename Action::Goal> goal) {
    control::NavigationGoal wish{id, {}};
    std::string why_not = read(poses_of(*goal), wish);
    if (!is_active_) why_not = "the node is not active";
    if (!goal->behavior_tree.empty()) why_not = "Docent has no behavior trees";
    if (why_not.empty()) return GoalResponse::ACCEPT_AND_EXECUTE;
    RCLCPP_WARN(get_logger(), "%s: refused: %s", name.c_str(), why_not.c_str());
    return GoalResponse::REJECT;
  };
  const auto cancel = [this](Handle<Action> handle) {
    if (handles_.find(handle->get_goal_id()) == handles_.end()) return CancelResponse::REJECT;
    goals_->cancel(handle->get_goal_id(), clock());
    return CancelResponse::ACCEPT;  // what follows is told by the next step, when the handle knows that it is canceling
  };
  const auto begin = [this](Handle<Action> handle) {
    control::NavigationGoal goal{handle->get_goal_id(), {}};
    const std::string why_not = read(poses_of(*handle->get_goal()), goal);
    handles_[goal.id] = handle;
    if (why_not.empty())
      goals_->begin(std::move(goal), clock());
    else
      finish({goal.id, control::GoalOutcome::aborted, why_not});
    flush();
  };
  return rclcpp_action::create_server<Action>(this, name, take, cancel, begin);
}

void NavigatorNode::step() {
  if (!is_active_) return;
  goals_->tick(clock());
  flush();
  const auto progress = goals_->progress(clock());
  if (!progress) return;
  const auto handle = handles_.find(progress->id);
  if (handle == handles_.end()) return;
  std::visit([&](const auto& typed) { feed_back(typed, *progress); }, handle->second);
}

void NavigatorNode::flush() {
  auto actions = goals_->take_actions();
  for (const control::StaffRequest& order : actions.requests) {
    docent_msgs::msg::Request request;
    request.id = order.id;
    request.stamp = now();
    request.source = docent::to_text(docent::RequestSource::staff);
    request.visitor = visitor_;
    request.kind = docent::to_text(order.kind);
    request.target = order.target;
    request.viewpoint = -1;
    requests_->publish(request);
  }
  for (const control::GoalEnd& end : actions.ends) finish(end);
}

void NavigatorNode::finish(const control::GoalEnd& end) {
  const auto place = handles_.find(end.id);
  if (place == handles_.end()) return;
  const AnyHandle handle = place->second;
  handles_.erase(place);
  std::visit(
      [&]<class Action>(const std::shared_ptr<rclcpp_action::ServerGoalHandle<Action>>& typed) {
        if (!typed->is_active()) return;
        const auto result = std::make_shared<typename Action::Result>();
        if (end.outcome == control::GoalOutcome::aborted) {
          result->error_code = control::error_code_of(end.reason);
          result->error_msg = end.reason;
          RCLCPP_WARN(get_logger(), "a goal was aborted: %s", end.reason.c_str());
          typed->abort(result);
        } else if (end.outcome == control::GoalOutcome::canceled) {
          typed->canceled(result);
        } else {
          typed->succeed(result);
        }
      },
      handle);
}

template <class Action>
void NavigatorNode::feed_back(const Handle<Action>& handle, const control::GoalProgress& progress) const {
  if (!handle->is_executing()) return;
  const auto feedback = std::make_shared<typename Action::Feedback>();
  feedback->current_pose.header.frame_id = frame_;
  feedback->current_pose.header.stamp = now();
  if (progress.map_from_base) feedback->current_pose.pose = to_message(*progress.map_from_base);
  feedback->navigation_time = to_duration(progress.navigation_s);
  feedback->estimated_time_remaining = to_duration(progress.remaining_s);
  feedback->distance_remaining = static_cast<float>(progress.distance_m);
  feedback->number_of_recoveries = static_cast<std::int16_t>(progress.blocked);
  if constexpr (std::is_same_v<Action, ThroughPoses>)
    feedback->number_of_poses_remaining = static_cast<std::int16_t>(progress.poses_remaining);
  handle->publish_feedback(feedback);
}

}  // namespace docent_ros
