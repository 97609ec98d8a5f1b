#pragma once

#include <optional>
#include <string>

#include "docent/messages/dock_topics.h"
#include "docent/modules/guide/dock_client.h"
#include "docent/task_control/golex/executive.h"

namespace docent::modules {

/// The executive's end of docking by the charger's tag: orders it of the module `dock`, and tells the executive how
/// that goes. A robot without such an eye hears nothing, and docks as if there were no tag.
class TagDock {
 public:
  explicit TagDock(transport::Bus& bus);
  TagDock(const TagDock&) = delete;  // the subscription holds `this`
  TagDock& operator=(const TagDock&) = delete;

  /// Several times a second, before the executive's own tick.
  void tick(task_control::Executive& executive);

 private:
  static constexpr Duration kSilent = std::chrono::seconds{2};  // `dock` speaks twice a second

  transport::Bus& bus_;
  transport::Publisher<docent_msgs::DriveGoal> orders_;
  std::string ordered_;
  docent_msgs::GoalState heard_;
  Time heard_at_{};
};

/// The executive's end of `docent/drive_goal`. Of a base that docks by itself it also sees to the dock: docks it where
/// the executive waits for a contact, undocks it before anything is driven to, and holds the goal back meanwhile; of
/// one that sees the charger's tag, to docking by that.
class DriveGoals {
 public:
  DriveGoals(transport::Bus& bus, bool docks_by_action);

  /// Where the executive wants the robot from now on.
  void order(const task_control::DriveOrder& order);
  /// Several times a second. Tells the executive what the dock says, and how docking by the tag goes.
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
  TagDock tag_;
  transport::Publisher<docent_msgs::DriveGoal> goal_;
  docent_msgs::DriveGoal ordered_;
  bool was_held_ = false;
};

}  // namespace docent::modules
