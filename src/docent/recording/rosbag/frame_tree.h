#pragma once

#include <map>
#include <optional>
#include <string>

#include "docent/geometry/pose2.h"
#include "docent/messages/standard_messages.h"

namespace docent::recording {

/// Where a sensor is on its robot.
struct Mount {
  Pose2 base_from_sensor;  ///< [m, rad]
  bool is_upside_down = false;
};

/// Frames and what lies between them, of one name space. Those that were said once for all win over those that are said
/// again and again, as some programs send what never changes.
class FrameTree {
 public:
  void add_static(const geometry_msgs::TransformStamped& transform);
  void add_moving(const geometry_msgs::TransformStamped& transform);
  /// From the robot's base, which is `base` or what is usually called so, to the frame. nullopt: nobody says it, or it
  /// lies far off any robot.
  [[nodiscard]] std::optional<Mount> mount_of(const std::string& frame, const std::string& base) const;

 private:
  std::map<std::string, geometry_msgs::TransformStamped> static_, moving_;  ///< by child frame
};

/// Without a leading slash, as ROS 1 wrote some.
[[nodiscard]] std::string plain_frame(const std::string& frame);
/// Odometry told by a transform: from a frame called odom to the robot's base.
[[nodiscard]] bool tells_odometry(const geometry_msgs::TransformStamped& transform);

}  // namespace docent::recording
