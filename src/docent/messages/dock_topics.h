#pragma once

#include "docent/messages/topics.h"

// Topics of docking by the charger's tag. Who names them includes this header.
// Recordings leave them out: what came of them is in the odometry and the events.

namespace docent {
namespace topics {

/// Ahead, as JPEG files; as pictures it is kFrontImage.
inline constexpr Topic<sensor_msgs::CompressedImage> kFrontPicture{"front_camera/image/compressed", Qos::sensor, 1};
/// Where the charger's tag stands: its middle on the floor, x out of it towards who docks; frame odom.
inline constexpr Topic<geometry_msgs::PoseWithCovarianceStamped> kDockPose{"docent/dock_pose", Qos::sensor};
/// To dock at the charger whose contacts are at the pose; without an id: no more.
inline constexpr Topic<docent_msgs::DriveGoal> kDockOrder{"docent/dock_order", Qos::state};
/// How that goes: idle (it could), driving, arrived, unreachable (it cannot, `reason` says why).
inline constexpr Topic<docent_msgs::GoalState> kDockState{"docent/dock_state", Qos::state};
/// What the avoidance should drive meanwhile, as far as that is safe.
inline constexpr Topic<docent_msgs::Drive> kDockDrive{"docent/dock_drive", Qos::command, 0, 0.3};

}  // namespace topics
}  // namespace docent
