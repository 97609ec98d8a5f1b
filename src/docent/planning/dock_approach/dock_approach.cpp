#include "docent/planning/dock_approach/dock_approach.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace docent::planning {

Result<void> DockApproachParams::validate() const {
  if (!(contact > 0.0 && straight > 0.0)) return fail("dock approach: contact and straight must be > 0");
  if (!(speed > 0.0 && last_speed > 0.0 && press_speed > 0.0 && turn > 0.0))
    return fail("dock approach: speeds and turn must be > 0");
  if (!(towards > 0.0 && bearing > towards && heading < 0.0))
    return fail("dock approach: it takes towards > 0, bearing > towards, heading < 0");
  if (!(across > 0.0 && along > 0.0)) return fail("dock approach: across and along must be > 0");
  if (!(most_across > 0.0 && most_angle > 0.0)) return fail("dock approach: most_across and most_angle must be > 0");
  if (!(judged > 0.0 && judged < straight)) return fail("dock approach: judged must be in (0, straight)");
  if (!(back_off > 0.0 && attempts >= 1)) return fail("dock approach: back_off must be > 0 and attempts >= 1");
  if (!(look_s > 0.0 && wait_s > 0.0 && press >= 0.0))
    return fail("dock approach: look_s and wait_s must be > 0 and press >= 0");
  return {};
}

DockApproach::Command DockApproach::limited(double speed, double turn) const {
  // A turn that the base cannot make slows it, so that the arc stays.
  const double part = std::min(1.0, params_.turn / std::max(1e-9, std::abs(turn)));
  return {speed * part, turn * part};
}

DockApproach::Command DockApproach::step(const DockApproachView& view, Time now) {
  if (state_ == State::docked || state_ == State::failed) return {};
  if (view.is_touching) {
    state_ = State::docked;
    return {};
  }
  if (state_ == State::waits) {
    if (now - since_ >= seconds(params_.wait_s)) begin_anew();
    return {};
  }
  if (!view.odom_from_tag) {  // no line, or no more: what was driven by it was driven by a guess
    if (state_ != State::looks) since_ = now;
    state_ = State::looks;
    return look(view, now);
  }
  if (state_ == State::looks) state_ = State::curves;
  const Pose2 tag_from_base = inverse(*view.odom_from_tag) * view.odom_from_base;
  if (state_ == State::curves) return curve(tag_from_base, now);
  if (state_ == State::goes_straight) return go_straight(tag_from_base, now);
  return back_off(tag_from_base);
}

/// Turns to where the tag should be, and sweeps about that.
DockApproach::Command DockApproach::look(const DockApproachView& view, Time now) {
  const double lasted = to_seconds(now - since_);
  if (lasted > params_.look_s) {
    state_ = State::failed;
    return {};
  }
  constexpr double kSweep = 0.35, kPeriod = 8.0;  // [rad], [s]
  const double sweep = kSweep * std::sin(2.0 * std::numbers::pi * lasted / kPeriod);
  const Angle to = direction(view.odom_from_base.position(), view.odom_from_expected.position());
  const double off = (to + Angle::radians(sweep) - view.odom_from_base.theta).radians();
  return {0.0, std::clamp(2.0 * off, -params_.turn, params_.turn)};
}

DockApproach::Command DockApproach::curve(const Pose2& tag_from_base, Time now) {
  const Pose2 tag_from_goal{params_.contact + params_.straight, 0.0, Angle::radians(-std::numbers::pi)};
  const Pose2 goal_from_base = inverse(tag_from_goal) * tag_from_base;
  const Point2 to_go = -1.0 * goal_from_base.position();
  const double distance = norm(to_go);
  constexpr double kThere = 0.04;  // [m]
  if (distance < kThere || goal_from_base.x > 0.0) {
    state_ = State::goes_straight;
    return go_straight(tag_from_base, now);
  }
  const double direction_to_go = std::atan2(to_go.y, to_go.x);
  const double bearing = (Angle::radians(direction_to_go) - goal_from_base.theta).radians();
  constexpr double kAhead = 0.9;  // [rad]: what lies farther aside is turned to first
  if (std::abs(bearing) > kAhead) return {0.0, std::copysign(params_.turn, bearing)};
  const double speed = std::min(params_.speed, params_.towards * distance) * std::cos(bearing);
  const double slow = std::max(params_.last_speed * 0.5, speed);
  const double turn = params_.bearing * bearing + params_.heading * -direction_to_go;
  return limited(slow, turn * slow / (params_.towards * distance));
}

void DockApproach::begin_anew() {
  state_ = attempts_ < params_.attempts ? State::backs_off : State::failed;
  ++attempts_;
}

DockApproach::Command DockApproach::go_straight(const Pose2& tag_from_base, Time now) {
  const double to_go = tag_from_base.x - params_.contact;
  const double angle = (tag_from_base.theta - Angle::radians(std::numbers::pi)).radians();
  const bool is_off = std::abs(tag_from_base.y) > params_.most_across ||
                      std::abs(angle) > params_.most_angle * std::numbers::pi / 180.0;
  if (to_go < -params_.press) {
    state_ = State::waits;
    since_ = now;
    return {};
  }
  if (to_go < params_.judged && is_off) {
    begin_anew();
    return {};
  }
  // In the tag's frame y > 0 lies to the right of who drives towards it: there the base turns left.
  const double curvature = params_.across * tag_from_base.y - params_.along * angle;
  const double speed = to_go < params_.judged ? params_.press_speed : params_.last_speed;
  return limited(speed, speed * curvature);
}

DockApproach::Command DockApproach::back_off(const Pose2& tag_from_base) {
  if (tag_from_base.x > params_.contact + params_.straight + params_.back_off) {
    state_ = State::curves;
    return {};
  }
  const double angle = (tag_from_base.theta - Angle::radians(std::numbers::pi)).radians();
  return limited(-0.5 * params_.speed, -0.5 * params_.speed * -2.0 * angle);
}

}  // namespace docent::planning
