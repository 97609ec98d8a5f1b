#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "docent/messages/standard_messages.h"

// irobot_create_msgs as of ROS 2 Humble and Jazzy, and of action_msgs what an action's client needs.

namespace docent {
namespace irobot_create_msgs {

/// One hazard; the frame says which sensor found it.
struct HazardDetection {
  static constexpr const char* kType = "irobot_create_msgs/msg/HazardDetection";
  static constexpr std::uint8_t kBackupLimit = 0;      ///< it drives back no farther
  static constexpr std::uint8_t kBump = 1;             ///< frame bump_left, bump_front_left, bump_front_center, …
  static constexpr std::uint8_t kCliff = 2;            ///< frame cliff_side_left, cliff_front_left, …
  static constexpr std::uint8_t kStall = 3;            ///< the wheels stall against something
  static constexpr std::uint8_t kWheelDrop = 4;        ///< a wheel hangs in the air
  static constexpr std::uint8_t kObjectProximity = 5;  ///< something is near
  std_msgs::Header header;
  std::uint8_t type = 0;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("type", m.type);
  }
};

/// All hazards of now, sent at a steady rate, also when there is none.
struct HazardDetectionVector {
  static constexpr const char* kType = "irobot_create_msgs/msg/HazardDetectionVector";
  std_msgs::Header header;
  std::vector<HazardDetection> detections;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("detections", m.detections);
  }
};

/// Whether somebody carries the robot.
struct KidnapStatus {
  static constexpr const char* kType = "irobot_create_msgs/msg/KidnapStatus";
  std_msgs::Header header;
  bool is_kidnapped = false;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("is_kidnapped", m.is_kidnapped);
  }
};

/// The dock.
struct DockStatus {
  static constexpr const char* kType = "irobot_create_msgs/msg/DockStatus";
  std_msgs::Header header;
  bool dock_visible = false;
  bool is_docked = false;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("dock_visible", m.dock_visible);
    v("is_docked", m.is_docked);
  }
};

/// A goal of an action whose goal has no field, behind a header that says the same as its id (see README.md).
struct SendGoal {
  std::array<std::uint8_t, 16> request_id{};
  std::array<std::uint8_t, 16> goal_id{};
  std::uint8_t structure_needs_at_least_one_member = 0;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("request_id", m.request_id);
    v("goal_id", m.goal_id);
    v("structure_needs_at_least_one_member", m.structure_needs_at_least_one_member);
  }
};
struct SendDockGoal : SendGoal {
  static constexpr const char* kType = "irobot_create_msgs/action/Dock_SendGoal_Request";
};
struct SendUndockGoal : SendGoal {
  static constexpr const char* kType = "irobot_create_msgs/action/Undock_SendGoal_Request";
};

}  // namespace irobot_create_msgs
}  // namespace docent

namespace docent {
namespace unique_identifier_msgs {

struct UUID {
  static constexpr const char* kType = "unique_identifier_msgs/msg/UUID";
  std::array<std::uint8_t, 16> uuid{};
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("uuid", m.uuid);
  }
};

}  // namespace unique_identifier_msgs
}  // namespace docent

namespace docent {
namespace action_msgs {

struct GoalInfo {
  static constexpr const char* kType = "action_msgs/msg/GoalInfo";
  unique_identifier_msgs::UUID goal_id;
  builtin_interfaces::Time stamp;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("goal_id", m.goal_id);
    v("stamp", m.stamp);
  }
};

struct GoalStatus {
  static constexpr const char* kType = "action_msgs/msg/GoalStatus";
  static constexpr std::int8_t kAccepted = 1;
  static constexpr std::int8_t kExecuting = 2;
  static constexpr std::int8_t kCanceling = 3;
  static constexpr std::int8_t kSucceeded = 4;
  static constexpr std::int8_t kCanceled = 5;
  static constexpr std::int8_t kAborted = 6;
  GoalInfo goal_info;
  std::int8_t status = 0;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("goal_info", m.goal_info);
    v("status", m.status);
  }
};

/// Of all goals that an action's server remembers, in the order in which it took them.
struct GoalStatusArray {
  static constexpr const char* kType = "action_msgs/msg/GoalStatusArray";
  std::vector<GoalStatus> status_list;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("status_list", m.status_list);
  }
};

}  // namespace action_msgs
}  // namespace docent
