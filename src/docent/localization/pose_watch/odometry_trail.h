#pragma once

#include <optional>

#include "docent/base/time.h"
#include "docent/geometry/pose2.h"
#include "docent/motion_models/odometry_history.h"
#include "docent/motion_models/unbroken_odometry.h"

namespace docent::localization {

/// Where the robot was in the last moments. The belief moves by odometry without jumps, in the frame `odom` here; what
/// others get is in the odometry's own frame, `raw`.
class OdometryTrail {
 public:
  explicit OdometryTrail(const motion_models::BaseReach& base = {}) : unbroken_{base} {}

  void add(Time stamp, const Pose2& raw_from_base);

  /// Beyond the newest reading it is carried on as the robot went: odometry may be on its way. None: nobody knows, it
  /// is too old or too new.
  [[nodiscard]] std::optional<Pose2> at(Time stamp) const;
  [[nodiscard]] bool empty() const { return history_.empty(); }
  [[nodiscard]] const Pose2& latest() const { return history_.latest(); }    ///< @pre not empty
  [[nodiscard]] Time latest_time() const { return history_.latest_time(); }  ///< @pre not empty
  /// As the odometry was torn at `stamp`.
  [[nodiscard]] const Pose2& odom_from_raw(Time stamp) const { return unbroken_.odom_from_raw(stamp); }
  [[nodiscard]] Pose2 in_raw(const Pose2& odom_from_pose, Time stamp) const {
    return inverse(odom_from_raw(stamp)) * odom_from_pose;
  }
  /// Whether the odometry has jumped at `stamp` or before; true once for each jump. Others carry a belief of before by
  /// an odometry that is torn.
  [[nodiscard]] bool take_jump(Time stamp);

 private:
  motion_models::UnbrokenOdometry unbroken_;
  motion_models::OdometryHistory history_;
  bool has_jumped_ = false;
};

}  // namespace docent::localization
