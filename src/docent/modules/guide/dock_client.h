#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "docent/messages/create3/create3_messages.h"
#include "docent/transport/bus.h"

namespace docent::modules {

struct DockClientParams {
  double accept_s = 3.0;  ///< [s] after a goal was sent, until the base says that it has taken it: else it has refused
  double action_s = 120.0;  ///< [s] that docking or undocking may take; a Create 3 needs some 10 to 30
  double retry_s = 5.0;     ///< [s] from a failure to the next goal
};

/// Docks and undocks a base that does so by itself, by ROS 2's actions /dock and /undock of irobot_create_msgs
/// (messages/create3). While the base is at it, it obeys no velocity. Asks the base for what is wanted, again after a
/// failure; what has come of a goal, the action's status topic says. One thread; time comes from the bus.
class DockClient {
 public:
  enum class Wish { none, docked, free };

  explicit DockClient(transport::Bus& bus) : DockClient(bus, DockClientParams{}) {}
  DockClient(transport::Bus& bus, const DockClientParams& params);
  DockClient(const DockClient&) = delete;  // the subscriptions hold `this`
  DockClient& operator=(const DockClient&) = delete;

  /// What is wanted from now on.
  void want(Wish wish);
  /// Several times a second.
  void tick();

  /// It has said whether it stands in its dock.
  [[nodiscard]] bool is_known() const { return is_known_; }
  /// It stands in its dock, as far as it says.
  [[nodiscard]] bool is_docked() const { return is_docked_; }
  /// It docks or undocks by itself.
  [[nodiscard]] bool is_moving() const { return goal_.has_value(); }
  /// Why it does not do what is wanted; empty: it does.
  [[nodiscard]] const std::string& complaint() const { return complaint_; }

 private:
  using GoalId = std::array<std::uint8_t, 16>;
  struct Goal {
    Wish wish = Wish::none;
    GoalId id{};
    Time sent;
    bool is_accepted = false;
  };
  [[nodiscard]] bool is_fulfilled() const;
  [[nodiscard]] GoalId next_id();
  void send();
  void hear(Wish of, const action_msgs::GoalStatusArray& goals);
  void fail(std::string why);

  transport::Bus& bus_;
  DockClientParams params_;
  transport::Publisher<irobot_create_msgs::SendDockGoal> dock_;
  transport::Publisher<irobot_create_msgs::SendUndockGoal> undock_;
  Wish wish_ = Wish::none;
  std::optional<Goal> goal_;
  std::uint64_t goals_ = 0;     ///< that were sent
  std::optional<Time> failed_;  ///< the last goal
  std::string complaint_;
  bool is_docked_ = false;  ///< by the base's last word
  bool is_known_ = false;   ///< there was one
};

}  // namespace docent::modules
