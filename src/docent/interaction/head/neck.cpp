#include "docent/interaction/head/neck.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace docent::interaction {
namespace {

constexpr double kGap = 1.0;  // [s] whoever was silent for so long begins anew

double difference(double to, double from) { return (Angle::radians(to) - Angle::radians(from)).radians(); }

bool is_same(const GazeTarget& a, const GazeTarget& b) { return a.at == b.at && a.person == b.person; }

}  // namespace

Result<void> NeckParams::validate() const {
  if (!(pan_range > 0.0 && pan_range <= std::numbers::pi)) return fail("neck.pan_range must be > 0 and <= pi");
  if (!(tilt_range > 0.0 && tilt_range <= std::numbers::pi / 2.0))
    return fail("neck.tilt_range must be > 0 and <= pi/2");
  if (!(pan_speed > 0.0)) return fail("neck.pan_speed must be > 0");
  if (!(tilt_speed > 0.0)) return fail("neck.tilt_speed must be > 0");
  if (!(acceleration > 0.0)) return fail("neck.acceleration must be > 0");
  if (!(settling_s > 0.0)) return fail("neck.settling_s must be > 0");
  return {};
}

double Neck::reachable_pan(double bearing) const {
  if (std::abs(bearing) <= params_.pan_range) return bearing;
  // Behind: from the end on whose side the head is.
  return std::clamp(pan_.position + difference(bearing, pan_.position), -params_.pan_range, params_.pan_range);
}

void Neck::turn(JointState& joint, double target, double target_speed, double range, double speed,
                double seconds) const {
  const double target_before = target - target_speed * seconds;
  const double wanted = std::clamp(
      (target_before - joint.position) / std::max(params_.settling_s, seconds) + target_speed, -speed, speed);
  const double change = params_.acceleration * seconds;
  joint.velocity = std::clamp(wanted, joint.velocity - change, joint.velocity + change);
  const double next = joint.position + joint.velocity * seconds;
  joint.position = std::clamp(next, -range, range);
  if (joint.position != next) joint.velocity = 0.0;
}

void Neck::step(const GazeTarget& target, Time now) {
  const double passed = last_ ? to_seconds(now - *last_) : 0.0;
  if (last_ && passed <= 0.0) return;
  if (!last_ || passed > kGap) {
    pan_.velocity = 0.0;
    tilt_.velocity = 0.0;
  } else {
    const bool moves_on = is_same(target, last_target_);
    const double pan_rate = moves_on ? difference(target.pan, last_target_.pan) / passed : 0.0;
    const double tilt_rate = moves_on ? (target.tilt - last_target_.tilt) / passed : 0.0;
    turn(pan_, reachable_pan(target.pan), pan_rate, params_.pan_range, params_.pan_speed, passed);
    turn(tilt_, std::clamp(target.tilt, -params_.tilt_range, params_.tilt_range), tilt_rate, params_.tilt_range,
         params_.tilt_speed, passed);
  }
  last_ = now;
  last_target_ = target;
}

}  // namespace docent::interaction
