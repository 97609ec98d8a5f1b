#pragma once

#include "docent/base/time.h"
#include "docent/geometry/pose2.h"
#include "docent/messages/standard_messages.h"

namespace docent {

[[nodiscard]] inline builtin_interfaces::Time to_message(Time time) {
  constexpr std::int64_t kSecond = 1000000000;
  std::int64_t sec = time.nanoseconds / kSecond;
  std::int64_t rest = time.nanoseconds % kSecond;
  if (rest < 0) {
    rest += kSecond;
    --sec;
  }
  return {static_cast<std::int32_t>(sec), static_cast<std::uint32_t>(rest)};
}
[[nodiscard]] inline Time from_message(const builtin_interfaces::Time& time) {
  return {static_cast<std::int64_t>(time.sec) * 1000000000 + time.nanosec};
}

[[nodiscard]] inline geometry_msgs::Quaternion to_quaternion(Angle yaw) {
  return {0.0, 0.0, std::sin(yaw.radians() / 2.0), std::cos(yaw.radians() / 2.0)};
}
[[nodiscard]] inline Angle yaw_of(const geometry_msgs::Quaternion& q) {
  return Angle::radians(std::atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z)));
}
[[nodiscard]] inline geometry_msgs::Pose to_message(const Pose2& pose) {
  return {{pose.x, pose.y, 0.0}, to_quaternion(pose.theta)};
}
[[nodiscard]] inline Pose2 from_message(const geometry_msgs::Pose& pose) {
  return {pose.position.x, pose.position.y, yaw_of(pose.orientation)};
}

}  // namespace docent
