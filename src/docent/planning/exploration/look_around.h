#pragma once

#include <optional>
#include <span>

#include "docent/base/time.h"
#include "docent/geometry/pose2.h"

namespace docent {

struct LookAroundStep {
  bool drive = false;  ///< else turn
  Point2 via{};        ///< [m], odom: where to drive
  Angle heading{};     ///< odom: where to turn
};

/// Moves a robot that does not know where it is (architecture 8.4): a full turn on the spot, then a short drive into
/// the widest direction that its sensors and the virtual measurements of its whole belief leave free, then another
/// turn.
class LookAround {
 public:
  /// Starts over.
  void start(Time now);
  /// @param odom_from_base  where the robot is, odometry
  /// @param clearances  [180] free distance [m] round the robot, every 2 degrees from -180, base frame: the smaller of
  /// real and virtual measurements; empty: not known, only turning is safe
  [[nodiscard]] LookAroundStep step(const Pose2& odom_from_base, std::span<const double> clearances, Time now);

 private:
  enum class Phase { turning, driving } phase_ = Phase::turning;
  double turned_ = 0.0;  ///< [rad] in this turn
  std::optional<Angle> last_heading_;
  std::optional<Point2> aim_;
  Time phase_start_{};
};

}  // namespace docent
