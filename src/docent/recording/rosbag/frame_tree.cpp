#include "docent/recording/rosbag/frame_tree.h"

#include <algorithm>
#include <cmath>

namespace docent::recording {
namespace {

using geometry_msgs::Quaternion;
using geometry_msgs::Transform;
using geometry_msgs::Vector3;

constexpr int kMostLinks = 32;           ///< of a chain of frames; a longer one is a ring
constexpr double kFarthestMount = 20.0;  ///< [m] from the robot's centre; no robot is so large
constexpr double kMoved = 0.01;          ///< [m, rad] less is what a calibration may add

/// Turns `v` by the rotation `q`.
Vector3 rotated(const Quaternion& q, const Vector3& v) {
  const auto cross = [](const Vector3& a, const Vector3& b) {
    return Vector3{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  };
  const Vector3 axis{q.x, q.y, q.z};
  const auto once = cross(axis, v);
  const auto twice = cross(axis, once);
  return {v.x + 2.0 * (q.w * once.x + twice.x), v.y + 2.0 * (q.w * once.y + twice.y),
          v.z + 2.0 * (q.w * once.z + twice.z)};
}
Quaternion normalized(const Quaternion& q) {
  const double length = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
  return {q.x / length, q.y / length, q.z / length, q.w / length};
}
Quaternion product(const Quaternion& a, const Quaternion& b) {
  return {a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
          a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}
/// `a_from_b` after `b_from_c`.
Transform product(const Transform& a, const Transform& b) {
  const Vector3 turned = rotated(a.rotation, b.translation);
  return {{turned.x + a.translation.x, turned.y + a.translation.y, turned.z + a.translation.z},
          product(a.rotation, b.rotation)};
}
Transform inverse(const Transform& a) {
  const Quaternion back{-a.rotation.x, -a.rotation.y, -a.rotation.z, a.rotation.w};
  const Vector3 place = rotated(back, a.translation);
  return {{-place.x, -place.y, -place.z}, back};
}
bool are_apart(const Transform& a, const Transform& b) {
  const Transform between = product(inverse(a), b);
  const Vector3& way = between.translation;
  const Quaternion& turn = between.rotation;
  return std::hypot(way.x, way.y, way.z) > kMoved || 2.0 * std::hypot(turn.x, turn.y, turn.z) > kMoved;
}

/// "base_link" of "robot1/base_link".
std::string last_part(const std::string& frame) { return frame.substr(frame.rfind('/') + 1); }

}  // namespace

std::string plain_frame(const std::string& frame) { return frame.starts_with('/') ? frame.substr(1) : frame; }

std::string prefix_of(const std::string& frame) {
  const std::string plain = plain_frame(frame);
  const std::size_t slash = plain.rfind('/');
  return slash == std::string::npos ? std::string{} : plain.substr(0, slash);
}

bool is_base(const std::string& frame) {
  const std::string name = last_part(frame);
  return name == "base_link" || name == "base_footprint";
}

bool tells_odometry(const geometry_msgs::TransformStamped& transform) {
  const std::string child = last_part(transform.child_frame_id);
  return last_part(transform.header.frame_id).starts_with("odom") && child != "map" && !child.starts_with("odom");
}

void FrameTree::add(Links& links, const geometry_msgs::TransformStamped& transform) {
  geometry_msgs::TransformStamped unit = transform;
  unit.transform.rotation = normalized(transform.transform.rotation);
  const auto [place, is_new] = links.try_emplace(plain_frame(transform.child_frame_id));
  Link& link = place->second;
  if (is_new) link.first = unit.transform;
  link.moves = link.moves || are_apart(link.first, unit.transform);
  link.transform = std::move(unit);
}
void FrameTree::add_static(const geometry_msgs::TransformStamped& transform) { add(static_, transform); }
void FrameTree::add_moving(const geometry_msgs::TransformStamped& transform) { add(moving_, transform); }

void FrameTree::add(const FrameTree& other) {
  static_.insert(other.static_.begin(), other.static_.end());
  moving_.insert(other.moving_.begin(), other.moving_.end());
}

std::vector<FrameTree::Ancestor> FrameTree::ancestors_of(const std::string& frame) const {
  std::vector<Ancestor> all{{plain_frame(frame), {}, false}};
  while (all.size() <= kMostLinks) {
    const Ancestor& last = all.back();
    auto link = static_.find(last.frame);
    if (link == static_.end()) {
      link = moving_.find(last.frame);
      if (link == moving_.end()) return all;
    }
    const Link& to_parent = link->second;
    all.push_back({plain_frame(to_parent.transform.header.frame_id),
                   product(to_parent.transform.transform, last.from_asked), last.moves || to_parent.moves});
  }
  return {};
}

std::optional<Mount> FrameTree::mount_of(const std::string& frame, const std::string& base) const {
  const std::vector<Ancestor> sensor = ancestors_of(frame);
  const std::vector<Ancestor> robot = ancestors_of(base);
  const auto is_shared = [&](const Ancestor& above) {
    return std::any_of(robot.begin(), robot.end(), [&](const Ancestor& of) { return of.frame == above.frame; });
  };
  auto shared = std::find_if(sensor.begin(), sensor.end(), is_shared);
  Transform base_from_shared;
  bool moves = false;
  if (shared != sensor.end()) {
    const auto of_robot =
        std::find_if(robot.begin(), robot.end(), [&](const Ancestor& of) { return of.frame == shared->frame; });
    base_from_shared = inverse(of_robot->from_asked);
    moves = of_robot->moves;
  } else {
    shared = std::find_if(sensor.begin(), sensor.end(), [](const Ancestor& above) { return is_base(above.frame); });
    if (shared == sensor.end()) return std::nullopt;
  }
  const Transform mounted = product(base_from_shared, shared->from_asked);
  const Vector3 ahead = rotated(mounted.rotation, {1.0, 0.0, 0.0});
  const Vector3 up = rotated(mounted.rotation, {0.0, 0.0, 1.0});
  Mount mount;
  mount.base_from_sensor = {mounted.translation.x, mounted.translation.y, Angle::radians(std::atan2(ahead.y, ahead.x))};
  mount.is_upside_down = up.z < 0.0;
  mount.tilt = std::acos(std::min(1.0, std::abs(up.z)));
  mount.moves = moves || shared->moves;
  if (norm(mount.base_from_sensor.position()) > kFarthestMount) return std::nullopt;
  return mount;
}

}  // namespace docent::recording
