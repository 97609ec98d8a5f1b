#include "docent/transport/create3_support.h"

#include "docent/transport/type_support.h"

namespace docent::transport {
namespace {

template <Message T>
const TypeSupport& own_support() {
  static constexpr TypeSupport kSupport = support_of<T>();
  return kSupport;
}

}  // namespace

template <>
const TypeSupport& type_support<irobot_create_msgs::HazardDetectionVector>() {
  return own_support<irobot_create_msgs::HazardDetectionVector>();
}
template <>
const TypeSupport& type_support<irobot_create_msgs::KidnapStatus>() {
  return own_support<irobot_create_msgs::KidnapStatus>();
}
template <>
const TypeSupport& type_support<irobot_create_msgs::DockStatus>() {
  return own_support<irobot_create_msgs::DockStatus>();
}
template <>
const TypeSupport& type_support<irobot_create_msgs::SendDockGoal>() {
  return own_support<irobot_create_msgs::SendDockGoal>();
}
template <>
const TypeSupport& type_support<irobot_create_msgs::SendUndockGoal>() {
  return own_support<irobot_create_msgs::SendUndockGoal>();
}
template <>
const TypeSupport& type_support<action_msgs::GoalStatusArray>() {
  return own_support<action_msgs::GoalStatusArray>();
}

}  // namespace docent::transport
