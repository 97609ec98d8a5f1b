#include "docent/collision_avoidance/watches/odometry_watch.h"

#include <algorithm>
#include <cmath>

namespace docent::collision_avoidance {

namespace {

bool is_same(const Pose2& a, const Pose2& b) {
  return a.x == b.x && a.y == b.y && a.theta.radians() == b.theta.radians();
}

}  // namespace

void OdometryWatch::receive(Time now, Time stamp, const BaseState& state, bool jumped, const CommandHistory& commands) {
  freshness_.receive(now, stamp);
  if (jumped) jumped_ = now;
  rhythm_.receive(stamp);
  // The velocity of a jump is none.
  if (stamp_ && stamp > *stamp_ && !jumped) watch_for_freeze(now, stamp, state, commands);
  if (!stamp_ || stamp > *stamp_ || *stamp_ - stamp > seconds(params_.begins_anew)) {
    stamp_ = stamp;
    state_ = state;
  }
}

void OdometryWatch::watch_for_freeze(Time now, Time stamp, const BaseState& state, const CommandHistory& commands) {
  if (!is_same(state.odom_from_base, state_.odom_from_base)) {
    expected_ = state.velocity;
    expected_way_ = 0.0;
    frozen_.reset();
    return;
  }
  const double dt = std::min(params_.longest_step, to_seconds(stamp - *stamp_));
  // Commands carry the local time: `now`, not the stamp.
  expected_ = advance({{}, expected_}, commands.at(now - seconds(limits_.latency)), limits_, dt).velocity;
  expected_way_ += (std::abs(expected_.linear) + limits_.radius * std::abs(expected_.angular)) * dt;
  if (expected_way_ < params_.expected) return;
  frozen_ = now;
  expected_way_ = 0.0;
}

std::optional<Complaint> OdometryWatch::complaint(Time now) const {
  auto found = complaint_of(freshness_, now, "odometry", params_.complaints);
  if (frozen_)
    found = worse(
        found, Complaint{now - *frozen_ < seconds(params_.rest) ? 0.0 : params_.try_speed, "the odometry is frozen"});
  if (rhythm_.misses_many())
    found = worse(found, Complaint{params_.complaints.crippled_speed, "odometry messages are missing"});
  if (jumped_ && now - *jumped_ < seconds(params_.after_jump))
    found = worse(found, Complaint{params_.complaints.crippled_speed, "the odometry jumped"});
  return found;
}

}  // namespace docent::collision_avoidance
