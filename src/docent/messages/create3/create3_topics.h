#pragma once

#include "docent/messages/create3/create3_messages.h"
#include "docent/messages/topics.h"

// What a Create 3 publishes beside the topics of every base, and its actions. A recording has what Docent makes of
// them.

namespace docent {
namespace topics {

inline constexpr Topic<irobot_create_msgs::HazardDetectionVector> kHazards{"hazard_detection", Qos::sensor};
inline constexpr Topic<irobot_create_msgs::KidnapStatus> kKidnapStatus{"kidnap_status", Qos::sensor};
inline constexpr Topic<irobot_create_msgs::DockStatus> kDockStatus{"dock_status", Qos::sensor};
/// Of services: `transport` puts "rq/" before the name of a topic whose type is a request.
inline constexpr Topic<irobot_create_msgs::SendDockGoal> kSendDock{"dock/_action/send_goalRequest", Qos::command};
inline constexpr Topic<irobot_create_msgs::SendUndockGoal> kSendUndock{"undock/_action/send_goalRequest", Qos::command};
inline constexpr Topic<action_msgs::GoalStatusArray> kDockGoals{"dock/_action/status", Qos::state};
inline constexpr Topic<action_msgs::GoalStatusArray> kUndockGoals{"undock/_action/status", Qos::state};

}  // namespace topics
}  // namespace docent
