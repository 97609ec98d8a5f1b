#pragma once

#include <optional>
#include <string>

#include "docent/modules/guide/dock_client.h"
#include "docent/task_control/golex/executive.h"

namespace docent::modules {

/// The executive's end of `docent/drive_goal`. Of a base that docks by itself it also sees to the dock: docks it where
/// the executive waits for a contact, undocks it before anything is driven to, and holds the goal back meanwhile.
class DriveGoals {
 public:
  DriveGoals(transport::Bus& bus, bool docks_by_action);

  /// Where the executive wants the robot from now on.
  void order(const task_control::DriveOrder& order);
  /// Several times a second. Tells the executive what the dock says. Without such a base nothing happens.
  void tick(task_control::Executive& executive);
  /// The base docks by itself: its dock says whether there is a contact, and its battery does not.
  [[nodiscard]] bool knows_contact() const { return dock_.has_value(); }
  /// Why the base does not dock or undock; empty: it does.
  [[nodiscard]] std::string complaint() const { return dock_ ? dock_->complaint() : ""; }

 private:
  /// The base stands in its dock, moves by itself, or has not said which.
  [[nodiscard]] bool is_held() const;
  void publish();

  transport::Bus& bus_;
  std::optional<DockClient> dock_;
  transport::Publisher<docent_msgs::DriveGoal> goal_;
  docent_msgs::DriveGoal ordered_;
  bool was_held_ = false;
};

}  // namespace docent::modules
