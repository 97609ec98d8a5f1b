#include "docent/recording/rosbag/frame_tree.h"

#include <cmath>

namespace docent::recording {
namespace {

constexpr int kMostLinks = 32;           ///< of a chain of frames; a longer one is a ring
constexpr double kFarthestMount = 20.0;  ///< [m] from the robot's centre; no robot is so large

/// Turns `v` by the rotation `q`.
geometry_msgs::Vector3 rotated(const geometry_msgs::Quaternion& q, const geometry_msgs::Vector3& v) {
  const auto cross = [](const geometry_msgs::Vector3& a, const geometry_msgs::Vector3& b) {
    return geometry_msgs::Vector3{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  };
  const geometry_msgs::Vector3 axis{q.x, q.y, q.z};
  const auto once = cross(axis, v);
  const auto twice = cross(axis, once);
  return {v.x + 2.0 * (q.w * once.x + twice.x), v.y + 2.0 * (q.w * once.y + twice.y),
          v.z + 2.0 * (q.w * once.z + twice.z)};
}

/// "base_link" of "robot1/base_link".
std::string last_part(const std::string& frame) { return frame.substr(frame.rfind('/') + 1); }

bool is_base(const std::string& frame) {
  const std::string name = last_part(frame);
  return name == "base_link" || name == "base_footprint";
}

}  // namespace

std::string plain_frame(const std::string& frame) { return frame.starts_with('/') ? frame.substr(1) : frame; }

bool tells_odometry(const geometry_msgs::TransformStamped& transform) {
  return last_part(transform.header.frame_id) == "odom" && is_base(transform.child_frame_id);
}

void FrameTree::add_static(const geometry_msgs::TransformStamped& transform) {
  static_[plain_frame(transform.child_frame_id)] = transform;
}
void FrameTree::add_moving(const geometry_msgs::TransformStamped& transform) {
  moving_[plain_frame(transform.child_frame_id)] = transform;
}

std::optional<Mount> FrameTree::mount_of(const std::string& frame, const std::string& base) const {
  // From the sensor up to the base: each link takes what is known of the sensor into its parent's frame.
  geometry_msgs::Vector3 origin{};
  geometry_msgs::Vector3 ahead{1.0, 0.0, 0.0};
  geometry_msgs::Vector3 up{0.0, 0.0, 1.0};
  std::string at = frame;
  for (int links = 0; links < kMostLinks; ++links) {
    if (at == base || is_base(at)) {
      Mount mount;
      mount.base_from_sensor = {origin.x, origin.y, Angle::radians(std::atan2(ahead.y, ahead.x))};
      mount.is_upside_down = up.z < 0.0;
      if (norm(mount.base_from_sensor.position()) > kFarthestMount) return std::nullopt;
      return mount;
    }
    auto link = static_.find(at);
    if (link == static_.end()) {
      link = moving_.find(at);
      if (link == moving_.end()) return std::nullopt;
    }
    const geometry_msgs::Transform& parent_from_child = link->second.transform;
    origin = rotated(parent_from_child.rotation, origin);
    origin = {origin.x + parent_from_child.translation.x, origin.y + parent_from_child.translation.y,
              origin.z + parent_from_child.translation.z};
    ahead = rotated(parent_from_child.rotation, ahead);
    up = rotated(parent_from_child.rotation, up);
    at = plain_frame(link->second.header.frame_id);
  }
  return std::nullopt;
}

}  // namespace docent::recording
