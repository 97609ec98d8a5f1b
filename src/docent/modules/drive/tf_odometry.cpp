#include "docent/modules/drive/tf_odometry.h"

#include <cmath>
#include <string>

#include "docent/messages/message_fitness.h"

namespace docent::modules {
namespace {

std::string without_slash(const std::string& frame) { return frame.starts_with('/') ? frame.substr(1) : frame; }

bool is_odometry(const geometry_msgs::TransformStamped& transform) {
  const std::string child = without_slash(transform.child_frame_id);
  return without_slash(transform.header.frame_id) == "odom" && (child == "base_link" || child == "base_footprint");
}

}  // namespace

bool TfOdometry::hear(const nav_msgs::Odometry& odometry) {
  if (made_ && from_message(odometry.header.stamp) == *made_) return true;
  base_tells_ = true;
  made_.reset();
  return false;
}

std::optional<nav_msgs::Odometry> TfOdometry::take(const tf2_msgs::TFMessage& transforms, Time now) {
  if (base_tells_) return std::nullopt;
  for (const geometry_msgs::TransformStamped& transform : transforms.transforms) {
    if (!is_odometry(transform) || fault_of(transform)) continue;
    if (!first_) first_ = now;
    if (now - *first_ < seconds(params_.patience)) return std::nullopt;
    return odometry_of(transform);
  }
  return std::nullopt;
}

nav_msgs::Odometry TfOdometry::odometry_of(const geometry_msgs::TransformStamped& transform) {
  const Time stamp = from_message(transform.header.stamp);
  nav_msgs::Odometry odometry;
  odometry.header = {transform.header.stamp, "odom"};
  odometry.child_frame_id = "base_link";
  odometry.pose.pose = {{transform.transform.translation.x, transform.transform.translation.y, 0.0},
                        transform.transform.rotation};
  const Pose2 odom_from_base = from_message(odometry.pose.pose);
  if (!lately_.empty() && !(lately_.back().stamp < stamp)) lately_.clear();
  lately_.push_back({stamp, odom_from_base});
  while (lately_.size() > 2 && stamp - lately_[1].stamp >= seconds(params_.window)) lately_.pop_front();
  if (lately_.size() > 1) {
    const Pose2 motion = inverse(lately_.front().odom_from_base) * odom_from_base;
    const double elapsed = to_seconds(stamp - lately_.front().stamp);
    odometry.twist.twist.linear.x = motion.x / elapsed;
    odometry.twist.twist.angular.z = motion.theta.radians() / elapsed;
  }
  made_ = stamp;
  return odometry;
}

}  // namespace docent::modules
