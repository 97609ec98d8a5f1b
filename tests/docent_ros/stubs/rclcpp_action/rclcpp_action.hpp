// A stand-in for rclcpp_action of ROS 2 Jazzy; see ../rclcpp/rclcpp.hpp. A goal handle throws, as the real one does,
// where a goal is brought from one state into another that does not follow it.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <rclcpp/rclcpp.hpp>
#include <string>
#include <utility>

namespace rclcpp_action {

using GoalUUID = std::array<std::uint8_t, 16>;

enum class GoalResponse : std::int8_t { REJECT = 1, ACCEPT_AND_EXECUTE = 2, ACCEPT_AND_DEFER = 3 };
enum class CancelResponse : std::int8_t { REJECT = 1, ACCEPT = 2 };

template <class ActionT>
class ServerGoalHandle {
 public:
  enum class Status { executing, canceling, succeeded, canceled, aborted };
  ServerGoalHandle(GoalUUID id, std::shared_ptr<const typename ActionT::Goal> goal) : id_{id}, goal_{std::move(goal)} {}

  [[nodiscard]] bool is_canceling() const { return status == Status::canceling; }
  [[nodiscard]] bool is_active() const { return status == Status::executing || status == Status::canceling; }
  [[nodiscard]] bool is_executing() const { return status == Status::executing; }
  void publish_feedback(std::shared_ptr<typename ActionT::Feedback> message) { feedback = std::move(message); }
  void abort(typename ActionT::Result::SharedPtr message) { end(Status::aborted, is_active(), std::move(message)); }
  void succeed(typename ActionT::Result::SharedPtr message) { end(Status::succeeded, is_active(), std::move(message)); }
  void canceled(typename ActionT::Result::SharedPtr message) {
    end(Status::canceled, is_canceling(), std::move(message));
  }
  [[nodiscard]] const std::shared_ptr<const typename ActionT::Goal> get_goal() const { return goal_; }
  [[nodiscard]] const GoalUUID& get_goal_id() const { return id_; }

  // For the test.
  Status status = Status::executing;
  std::shared_ptr<typename ActionT::Feedback> feedback;
  typename ActionT::Result::SharedPtr result;

 private:
  void end(Status next, bool may, typename ActionT::Result::SharedPtr message) {
    if (!may) throw std::runtime_error{"goal_handle attempted invalid transition"};
    status = next;
    result = std::move(message);
  }
  GoalUUID id_;
  std::shared_ptr<const typename ActionT::Goal> goal_;
};

template <class ActionT>
class Server {
 public:
  using SharedPtr = std::shared_ptr<Server<ActionT>>;
  using GoalCallback = std::function<GoalResponse(const GoalUUID&, std::shared_ptr<const typename ActionT::Goal>)>;
  using CancelCallback = std::function<CancelResponse(std::shared_ptr<ServerGoalHandle<ActionT>>)>;
  using AcceptedCallback = std::function<void(std::shared_ptr<ServerGoalHandle<ActionT>>)>;
  Server(GoalCallback goal, CancelCallback cancel, AcceptedCallback accepted)
      : goal_{std::move(goal)}, cancel_{std::move(cancel)}, accepted_{std::move(accepted)} {}

  // For the test: what a client does. Null: the goal was rejected.
  std::shared_ptr<ServerGoalHandle<ActionT>> send_goal(const GoalUUID& id, const typename ActionT::Goal& goal) {
    const auto shared = std::make_shared<const typename ActionT::Goal>(goal);
    if (goal_(id, shared) == GoalResponse::REJECT) return nullptr;
    auto handle = std::make_shared<ServerGoalHandle<ActionT>>(id, shared);
    accepted_(handle);
    return handle;
  }
  bool cancel(const std::shared_ptr<ServerGoalHandle<ActionT>>& handle) {
    if (cancel_(handle) == CancelResponse::REJECT) return false;
    if (!handle->is_executing()) throw std::runtime_error{"goal_handle attempted invalid transition"};
    handle->status = ServerGoalHandle<ActionT>::Status::canceling;
    return true;
  }

 private:
  GoalCallback goal_;
  CancelCallback cancel_;
  AcceptedCallback accepted_;
};

template <class ActionT, class NodeT>
typename Server<ActionT>::SharedPtr create_server(NodeT node, const std::string& name,
                                                  typename Server<ActionT>::GoalCallback handle_goal,
                                                  typename Server<ActionT>::CancelCallback handle_cancel,
                                                  typename Server<ActionT>::AcceptedCallback handle_accepted) {
  auto server =
      std::make_shared<Server<ActionT>>(std::move(handle_goal), std::move(handle_cancel), std::move(handle_accepted));
  rclcpp::World::get().actions[node->resolved(name)] = std::weak_ptr(server);
  return server;
}

}  // namespace rclcpp_action
