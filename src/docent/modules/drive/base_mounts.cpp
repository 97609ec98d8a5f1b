#include "docent/modules/drive/base_mounts.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "docent/messages/conversions.h"

namespace docent::modules {
namespace {

constexpr const char* kBase = "base_link";

geometry_msgs::TransformStamped transform_of(const robot::Scanner& scanner) {
  const Pose2 mount = scanner.base_from_sensor();
  geometry_msgs::TransformStamped transform{
      {{}, kBase}, scanner.frame, {{mount.x, mount.y, 0.0}, to_quaternion(mount.theta)}};
  auto& turned = transform.transform.rotation;
  if (scanner.upside_down) turned = {turned.w, turned.z, 0.0, 0.0};  // half a turn about x before the yaw
  return transform;
}

std::string text_of(const Pose2& mount, bool is_upside_down) {
  char text[96];
  std::snprintf(text, sizeof text, "x %.3f, y %.3f, heading %.1f%s", mount.x, mount.y, mount.theta.degrees(),
                is_upside_down ? ", upside down" : "");
  return text;
}

}  // namespace

bool wants_mounts_of_base(const robot::RobotBody& body) {
  return std::any_of(body.scanners.begin(), body.scanners.end(),
                     [](const auto& scanner) { return !scanner.has_mount; });
}

BaseMounts::BaseMounts(const robot::RobotBody& body, const BaseMountsParams& params)
    : scanners_{body.scanners}, params_{params}, own_{transforms(false)} {}

tf2_msgs::TFMessage BaseMounts::transforms(bool of_base) const {
  tf2_msgs::TFMessage message;
  for (const robot::Scanner& scanner : scanners_)
    if (scanner.has_mount != of_base) message.transforms.push_back(transform_of(scanner));
  return message;
}

bool BaseMounts::is_own(const geometry_msgs::TransformStamped& transform) const {
  return std::any_of(own_.transforms.begin(), own_.transforms.end(), [&](const auto& own) {
    const auto& a = own.transform;
    const auto& b = transform.transform;
    return own.header.frame_id == transform.header.frame_id && own.child_frame_id == transform.child_frame_id &&
           a.translation.x == b.translation.x && a.translation.y == b.translation.y && b.translation.z == 0.0 &&
           a.rotation.x == b.rotation.x && a.rotation.y == b.rotation.y && a.rotation.z == b.rotation.z &&
           a.rotation.w == b.rotation.w;
  });
}

void BaseMounts::hear_static(const tf2_msgs::TFMessage& transforms) {
  for (const auto& transform : transforms.transforms)
    if (!is_own(transform)) frames_.add_static(transform);
}

void BaseMounts::hear(const tf2_msgs::TFMessage& transforms) {
  for (const auto& transform : transforms.transforms) frames_.add_moving(transform);
}

std::string BaseMounts::set_in(robot::RobotConfig& config) const {
  std::string missing;
  for (std::size_t i = 0; i < scanners_.size(); ++i) {
    if (scanners_[i].has_mount) continue;
    if (const auto mount = frames_.mount_of(recording::plain_frame(scanners_[i].frame), kBase)) {
      config.set_mount(i, mount->base_from_sensor, mount->is_upside_down);
    } else {
      missing += (missing.empty() ? "" : "; ") + std::string{"scanner "} + scanners_[i].name +
                 ": robot.yaml says no x, y and heading, and no /tf_static says where " + scanners_[i].frame +
                 " is on " + kBase;
    }
  }
  return missing;
}

std::string BaseMounts::contradictions() const {
  std::string text;
  for (const robot::Scanner& scanner : scanners_) {
    if (!scanner.has_mount) continue;
    const auto told = frames_.mount_of(recording::plain_frame(scanner.frame), kBase);
    if (!told) continue;
    const Pose2 ours = scanner.base_from_sensor();
    const Pose2& theirs = told->base_from_sensor;
    const double turn = std::abs((theirs.theta - ours.theta).degrees());
    if (distance(ours.position(), theirs.position()) <= params_.position && turn <= params_.heading &&
        told->is_upside_down == scanner.upside_down)
      continue;
    text += (text.empty() ? "" : "; ") + std::string{"/tf_static has scanner "} + scanner.name + " at " +
            text_of(theirs, told->is_upside_down) + ", robot.yaml at " + text_of(ours, scanner.upside_down) +
            ", which counts";
  }
  return text;
}

}  // namespace docent::modules
