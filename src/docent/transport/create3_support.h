#pragma once

#include "docent/messages/create3/create3_topics.h"
#include "docent/transport/bus.h"

// What a bus must know of the topics of messages/create3. Who names them includes this header.

namespace docent::transport {

template <>
[[nodiscard]] const TypeSupport& type_support<irobot_create_msgs::HazardDetectionVector>();
template <>
[[nodiscard]] const TypeSupport& type_support<irobot_create_msgs::KidnapStatus>();
template <>
[[nodiscard]] const TypeSupport& type_support<irobot_create_msgs::DockStatus>();
template <>
[[nodiscard]] const TypeSupport& type_support<irobot_create_msgs::SendDockGoal>();
template <>
[[nodiscard]] const TypeSupport& type_support<irobot_create_msgs::SendUndockGoal>();
template <>
[[nodiscard]] const TypeSupport& type_support<action_msgs::GoalStatusArray>();

}  // namespace docent::transport
