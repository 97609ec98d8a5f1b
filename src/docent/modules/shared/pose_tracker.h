#pragma once

#include <optional>

#include "docent/collision_avoidance/body/base_motion.h"
#include "docent/geometry/pose2.h"
#include "docent/messages/conversions.h"
#include "docent/messages/topics.h"
#include "docent/motion_models/unbroken_odometry.h"
#include "docent/robot/robot_config.h"

namespace docent::modules {

/// What the base can do: a longer step of its odometry is a jump.
[[nodiscard]] inline motion_models::BaseReach reach_of(const robot::RobotBody& body) {
  return {body.max_speed, body.max_turn_rate};
}

/// Carries the belief's best hypothesis forward with odometry. For modules that plan or draw; never for safety, which
/// uses the whole belief. Jumps of the odometry do not move it; what it says in odometry's frame is in the frame that
/// odometry itself speaks of at that moment.
class PoseTracker {
 public:
  explicit PoseTracker(const motion_models::BaseReach& base = {}) : unbroken_{base} {}

  void on_belief(const docent_msgs::Belief& belief) {
    localized_ = belief.localized && !belief.hypotheses.empty();
    if (belief.hypotheses.empty()) return;
    const auto& best = belief.hypotheses.front();
    belief_stamp_ = from_message(belief.header.stamp);
    map_from_odom_ = Pose2{best.x, best.y, Angle::radians(best.theta)} *
                     inverse(unbroken_.odom_from_raw(belief_stamp_) * from_message(belief.odom_pose));
  }
  void on_odometry(const nav_msgs::Odometry& odometry) { on_odometry(odometry, from_message(odometry.header.stamp)); }
  /// @param taken  the stamp, by the clock of whoever asks for poses
  void on_odometry(const nav_msgs::Odometry& odometry, Time taken) {
    const auto reading = unbroken_.add(taken, from_message(odometry.pose.pose));
    if (reading.is_late && !history_.empty()) return;
    if (reading.is_set_back) history_.forget();
    const collision_avoidance::Velocity told{odometry.twist.twist.linear.x, odometry.twist.twist.angular.z};
    const bool keeps = reading.jumped && !history_.empty();  // a base that derives it from its pose says nonsense
    history_.add(taken, {reading.odom_from_base, keeps ? history_.newest().velocity : told});
  }

  [[nodiscard]] bool localized() const { return localized_; }
  [[nodiscard]] std::optional<Pose2> odom_from_base() const {
    if (history_.empty()) return std::nullopt;
    return in_raw(history_.newest().odom_from_base, history_.newest_stamp());
  }
  [[nodiscard]] std::optional<Pose2> map_from_odom() const {
    if (!map_from_odom_ || history_.empty()) return map_from_odom_;
    return *map_from_odom_ * unbroken_.odom_from_raw(history_.newest_stamp());
  }
  /// Now, whether the robot is sure of it or not.
  [[nodiscard]] std::optional<Pose2> map_from_base() const {
    if (!map_from_odom_ || history_.empty()) return std::nullopt;
    return *map_from_odom_ * history_.newest().odom_from_base;
  }
  /// When a sensor of the same clock as the odometry took its reading, up to 6 s ago. A robot that turns at 1.2 rad/s
  /// has left the pose of a reading 7 degrees behind within a tenth of a second.
  [[nodiscard]] std::optional<Pose2> odom_from_base_at(Time stamp) const {
    if (history_.empty()) return std::nullopt;
    return in_raw(history_.pose_at(stamp), stamp);
  }
  [[nodiscard]] std::optional<Pose2> map_from_base_at(Time stamp) const {
    if (!map_from_odom_ || history_.empty()) return std::nullopt;
    return *map_from_odom_ * history_.pose_at(stamp);
  }
  [[nodiscard]] Time belief_stamp() const { return belief_stamp_; }

 private:
  /// In odometry's own frame, as it was at `stamp`.
  [[nodiscard]] Pose2 in_raw(const Pose2& odom_from_base, Time stamp) const {
    return inverse(unbroken_.odom_from_raw(stamp)) * odom_from_base;
  }

  bool localized_ = false;
  std::optional<Pose2> map_from_odom_;  ///< of the odometry without jumps, as is `history_`
  motion_models::UnbrokenOdometry unbroken_;
  collision_avoidance::BaseHistory history_;
  Time belief_stamp_{};
};

}  // namespace docent::modules
