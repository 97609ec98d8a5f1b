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
  if (stamp_ && stamp > *stamp_) {
    watch_for_gaps(to_seconds(stamp - *stamp_));
    if (!jumped) watch_for_freeze(now, stamp, state, commands);  // the velocity of a jump is none
  }
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

void OdometryWatch::watch_for_gaps(double gap) {
  if (usual_gap_ == 0.0) usual_gap_ = gap;
  // Only what is no gap teaches what is usual.
  if (gap < params_.gap * usual_gap_) usual_gap_ += params_.memory * (gap - usual_gap_);
  const double foretold = std::max(1.0, std::round(gap / usual_gap_));
  missing_ += params_.memory * (1.0 - 1.0 / foretold - missing_);
}

std::optional<Complaint> OdometryWatch::complaint(Time now) const {
  auto found = complaint_of(freshness_, now, "odometry", params_.complaints);
  if (frozen_)
    found = worse(
        found, Complaint{now - *frozen_ < seconds(params_.rest) ? 0.0 : params_.try_speed, "the odometry is frozen"});
  if (missing_ > params_.many_missing)
    found = worse(found, Complaint{params_.complaints.crippled_speed, "odometry messages are missing"});
  if (jumped_ && now - *jumped_ < seconds(params_.after_jump))
    found = worse(found, Complaint{params_.complaints.crippled_speed, "the odometry jumped"});
  return found;
}

}  // namespace docent::collision_avoidance
