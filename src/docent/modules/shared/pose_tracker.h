#pragma once

#include <optional>

#include "docent/collision_avoidance/body/base_motion.h"
#include "docent/geometry/pose2.h"
#include "docent/messages/conversions.h"
#include "docent/messages/topics.h"

namespace docent::modules {

/// Carries the belief's best hypothesis forward with odometry. For modules that plan or draw; never for safety, which
/// uses the whole belief.
class PoseTracker {
 public:
  void on_belief(const docent_msgs::Belief& belief) {
    localized_ = belief.localized && !belief.hypotheses.empty();
    if (belief.hypotheses.empty()) return;
    const auto& best = belief.hypotheses.front();
    map_from_odom_ = Pose2{best.x, best.y, Angle::radians(best.theta)} * inverse(from_message(belief.odom_pose));
    belief_stamp_ = from_message(belief.header.stamp);
  }
  void on_odometry(const nav_msgs::Odometry& odometry) { on_odometry(odometry, from_message(odometry.header.stamp)); }
  /// @param taken  the stamp, by the clock of whoever asks for poses
  void on_odometry(const nav_msgs::Odometry& odometry, Time taken) {
    const Pose2 odom_from_base = from_message(odometry.pose.pose);
    history_.add(taken, {odom_from_base, {odometry.twist.twist.linear.x, odometry.twist.twist.angular.z}});
    odom_from_base_ = history_.newest().odom_from_base;
  }

  [[nodiscard]] bool localized() const { return localized_; }
  [[nodiscard]] std::optional<Pose2> odom_from_base() const { return odom_from_base_; }
  [[nodiscard]] std::optional<Pose2> map_from_odom() const { return map_from_odom_; }
  /// Now, whether the robot is sure of it or not.
  [[nodiscard]] std::optional<Pose2> map_from_base() const {
    if (!map_from_odom_ || !odom_from_base_) return std::nullopt;
    return *map_from_odom_ * *odom_from_base_;
  }
  /// When a sensor of the same clock as the odometry took its reading, up to 6 s ago. A robot that turns at 1.2 rad/s
  /// has left the pose of a reading 7 degrees behind within a tenth of a second.
  [[nodiscard]] std::optional<Pose2> odom_from_base_at(Time stamp) const {
    if (history_.empty()) return std::nullopt;
    return history_.pose_at(stamp);
  }
  [[nodiscard]] std::optional<Pose2> map_from_base_at(Time stamp) const {
    const auto odom_from_base = odom_from_base_at(stamp);
    if (!map_from_odom_ || !odom_from_base) return std::nullopt;
    return *map_from_odom_ * *odom_from_base;
  }
  [[nodiscard]] Time belief_stamp() const { return belief_stamp_; }

 private:
  bool localized_ = false;
  std::optional<Pose2> map_from_odom_;
  std::optional<Pose2> odom_from_base_;
  collision_avoidance::BaseHistory history_;
  Time belief_stamp_{};
};

}  // namespace docent::modules
