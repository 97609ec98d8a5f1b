#pragma once

#include <optional>

#include "docent/base/time.h"
#include "docent/geometry/pose2.h"

namespace docent::motion_models {

/// Odometry whose jumps are taken out: an encoder that skips, a driver that begins anew at zero. No base makes such a
/// step, so the robot has not moved by it; what is kept in the odometry's frame would be torn by it.
///
/// A step is a jump when it differs from the last velocity carried on by more than any wheel can change it: 4 m/s2 and
/// 10 rad/s2 half the time squared, 6 cm and 5 degrees for noise. An odometry that repeats itself in full drive is
/// taken for frozen, not for standing, and is believed again wherever it wakes. O(1) a reading.
class UnbrokenOdometry {
 public:
  struct Reading {
    Pose2 odom_from_base;  ///< without jumps: the same as the odometry's own until the first one
    bool jumped = false;   ///< in this reading
  };

  /// Readings in the order of their stamps; one that is older than the last counts as the last, one that is older by a
  /// second or more begins anew: the clock was set.
  Reading add(Time stamp, const Pose2& raw_from_base);

  /// From the odometry's own frame, as it was at `stamp`, to the one without jumps. Knows the last jump only.
  [[nodiscard]] const Pose2& odom_from_raw(Time stamp) const;
  /// Stamp of the last jump; long ago before the first.
  [[nodiscard]] Time jumped() const { return jumped_; }

 private:
  void follow(double dt, const Pose2& motion);
  [[nodiscard]] bool is_jump(double dt, const Pose2& motion) const;

  std::optional<Time> stamp_;
  Time changed_{};        ///< when the pose last changed
  Pose2 raw_from_base_;   ///< newest
  double linear_ = 0.0;   ///< [m/s] of the last step that was none of standing still
  double angular_ = 0.0;  ///< [rad/s]
  Pose2 odom_from_raw_;   ///< now
  Pose2 odom_from_raw_before_;
  Time jumped_{};
};

}  // namespace docent::motion_models
