#pragma once

#include <optional>

#include "docent/base/time.h"
#include "docent/geometry/pose2.h"

namespace docent::collision_avoidance {

struct ContactWatchParams {
  double stands_for = 1.0;    ///< [s] after a touch the robot stands: somebody may be drawing the hand back
  double flinches_for = 0.4;  ///< [s] then it may leave who touched it: away from them, nobody minds
  double elsewhere = 0.8;     ///< [rad] between two touches: the later one is another touch
};

/// Watches who touches the robot: for how long by now, and when last.
class ContactWatch {
 public:
  explicit ContactWatch(const ContactWatchParams& params = {}) : params_{params} {}

  /// @param from_in_odom  bearing of the touched place, odometry's frame
  void feel(Time now, Angle from_in_odom);

  [[nodiscard]] bool is_touched(Time now, double within) const { return last_ && now - *last_ < seconds(within); }
  /// [s] that the robot must stand after a touch.
  [[nodiscard]] double stands_for() const { return params_.stands_for; }
  /// Whether the touch has lasted so long that the robot may go away from it.
  [[nodiscard]] bool may_leave(Time now) const { return now - since_ > seconds(params_.flinches_for); }

 private:
  ContactWatchParams params_;
  std::optional<Time> last_;
  Time since_{};
  Angle from_{};  ///< odom
};

}  // namespace docent::collision_avoidance
