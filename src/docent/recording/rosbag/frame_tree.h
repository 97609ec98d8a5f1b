#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "docent/geometry/pose2.h"
#include "docent/messages/standard_messages.h"

namespace docent::recording {

/// Where a sensor is on its robot.
struct Mount {
  Pose2 base_from_sensor;       ///< [m, rad]
  bool is_upside_down = false;  ///< it hangs
  double tilt = 0.0;            ///< [rad] of its plane against the floor, 0 to pi/2
  bool moves = false;           ///< what says its place says several: this is the last
};

/// Frames and what lies between them. Those that were said once for all win over those that are said again and again,
/// as some programs send what never changes.
class FrameTree {
 public:
  void add_static(const geometry_msgs::TransformStamped& transform);
  void add_moving(const geometry_msgs::TransformStamped& transform);
  /// What the other one says and this one does not.
  void add(const FrameTree& other);
  /// From the robot's base to the frame: over the frame that both hang on, whichever is the other's parent; where
  /// `base` is not in the tree, from what is usually called so. nullopt: nobody says it, or it lies far off any robot.
  [[nodiscard]] std::optional<Mount> mount_of(const std::string& frame, const std::string& base) const;

 private:
  struct Link {
    geometry_msgs::TransformStamped transform;  ///< the last one
    geometry_msgs::Transform first;
    bool moves = false;
  };
  /// A frame that others hang on, and where the one that was asked for is in it.
  struct Ancestor {
    std::string frame;
    geometry_msgs::Transform from_asked;
    bool moves = false;
  };
  using Links = std::map<std::string, Link>;  ///< by child frame
  static void add(Links& links, const geometry_msgs::TransformStamped& transform);
  /// The frame itself, its parent and so on.
  [[nodiscard]] std::vector<Ancestor> ancestors_of(const std::string& frame) const;

  Links static_, moving_;
};

/// Without a leading slash, as ROS 1 wrote some.
[[nodiscard]] std::string plain_frame(const std::string& frame);
/// "robot1" of "robot1/base_link"; empty: it has none.
[[nodiscard]] std::string prefix_of(const std::string& frame);
/// Whether it is what bases are usually called.
[[nodiscard]] bool is_base(const std::string& frame);
/// Odometry told by a transform: from a frame called odom, or odom_combined and the like, to the robot, whatever its
/// name.
[[nodiscard]] bool tells_odometry(const geometry_msgs::TransformStamped& transform);

}  // namespace docent::recording
