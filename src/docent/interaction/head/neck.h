#pragma once

#include <optional>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/geometry/angle.h"
#include "docent/interaction/head/gaze_choice.h"

namespace docent::interaction {

/// What a pan-tilt unit can do.
struct NeckParams {
  double pan_range = 2.4;     ///< [rad] > 0, to either side; most pan-tilt units stop short of the back
  double tilt_range = 0.6;    ///< [rad] > 0, upwards and downwards
  double pan_speed = 1.5;     ///< [rad/s] > 0: a head that turns faster looks like a machine
  double tilt_speed = 0.8;    ///< [rad/s] > 0
  double acceleration = 6.0;  ///< [rad/s2] > 0, of both joints
  double settling_s = 0.25;   ///< [s] > 0, in which the rest of a turn becomes a third; pan_speed / acceleration and
                              ///< more keep it from overshooting
  template <class V>
  void visit(V& v) {
    v("pan_range", pan_range);
    v("tilt_range", tilt_range);
    v("pan_speed", pan_speed);
    v("tilt_speed", tilt_speed);
    v("acceleration", acceleration);
    v("settling_s", settling_s);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// One joint on its way to where it should be.
struct JointState {
  double position = 0.0;  ///< [rad]
  double velocity = 0.0;  ///< [rad/s]
};

/// Turns the head smoothly, within the range, speed and acceleration of its joints. A target that moves evenly (the
/// robot turns under its head) is followed without lag. What lies behind the range is looked at from the nearer end of
/// it, and the head does not swing from end to end while it stays behind. Deterministic.
class Neck {
 public:
  explicit Neck(const NeckParams& params) : params_{params} {}
  /// Several times a second; times must not fall, and after a gap of more than a second the joints stand still.
  void step(const GazeTarget& target, Time now);
  [[nodiscard]] const JointState& pan() const { return pan_; }    ///< base_link, to the left
  [[nodiscard]] const JointState& tilt() const { return tilt_; }  ///< upwards

 private:
  [[nodiscard]] double reachable_pan(double bearing) const;
  void turn(JointState& joint, double target, double target_speed, double range, double speed, double seconds) const;

  NeckParams params_;
  JointState pan_;
  JointState tilt_;
  std::optional<Time> last_;
  GazeTarget last_target_;
};

}  // namespace docent::interaction
