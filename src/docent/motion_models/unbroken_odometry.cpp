#include "docent/motion_models/unbroken_odometry.h"

#include <algorithm>
#include <cmath>

namespace docent::motion_models {

namespace {

constexpr double kFirstPeriod = 0.1;     // [s] a first interval may be shorter than usual by far
constexpr double kPause = 5.0;           // usual intervals
constexpr double kLongestCarried = 0.5;  // [s] for which a base is taken to have driven on through a jump

bool is_same(const Pose2& a, const Pose2& b) {
  return a.x == b.x && a.y == b.y && a.theta.radians() == b.theta.radians();
}

}  // namespace

bool UnbrokenOdometry::counts(Time stamp) {
  if (stamp >= *stamp_) return true;
  rising_ = rising_ > 0 && stamp > late_stamp_ ? rising_ + 1 : 1;
  late_stamp_ = stamp;
  ++late_;
  return rising_ >= params_.enough;
}

UnbrokenOdometry::Gap UnbrokenOdometry::gap_to(Time stamp, bool is_set_back) const {
  const double usual = period_ * std::max(1, is_set_back ? late_ : late_ + 1);
  const double hidden = is_set_back && *stamp_ - stamp >= seconds(params_.reboot) ? params_.most_held : 0.0;
  const double elapsed = std::max(usual, to_seconds(stamp - changed_));
  const double driven = std::min(elapsed, std::max(usual, params_.base.longest_unheard));
  return {elapsed, driven + params_.jitter + std::max(held_, hidden)};
}

void UnbrokenOdometry::learn(double interval) {
  const double readings = 1.0 + late_;
  const double longest = readings * std::max(2.0 * period_, kFirstPeriod);
  if (period_ == 0.0) period_ = std::min(interval, longest);
  held_ = std::clamp(held_ * std::exp(-interval / params_.held_memory) + interval - readings * period_, 0.0,
                     params_.most_held);
  period_ += params_.learning * (std::min(interval, longest) / readings - period_);
}

bool UnbrokenOdometry::begins_anew(const Gap& gap, const Pose2& raw_from_base) const {
  if (is_same(raw_from_base, {})) return true;  // who drives never comes back to zero to the last digit
  const auto is_near_zero = [&](const Pose2& pose) {
    return norm(pose.position()) <= params_.near_zero && std::abs(pose.theta.radians()) <= params_.near_zero;
  };
  const bool is_pause = gap.elapsed >= params_.pause && gap.elapsed >= kPause * period_;
  return is_pause && is_near_zero(raw_from_base) && !is_near_zero(raw_from_base_);
}

bool UnbrokenOdometry::is_jump(const Gap& gap, const Pose2& raw_from_base, const Pose2& motion) const {
  const double way = norm(motion.position());
  const double turn = std::abs(motion.theta.radians());
  const bool is_noise = way <= params_.linear_noise && turn <= params_.angular_noise;
  if (!is_noise && begins_anew(gap, raw_from_base)) return true;
  return way > params_.linear_noise + params_.margin * params_.base.max_speed * gap.longest ||
         turn > params_.angular_noise + params_.margin * params_.base.max_turn_rate * gap.longest;
}

bool UnbrokenOdometry::in_full_drive() const {
  return std::abs(linear_) > params_.in_full_drive || std::abs(angular_) > params_.in_full_drive;
}

void UnbrokenOdometry::leave_out_step(Time stamp, const Gap& gap, const Pose2& raw_from_base) {
  const double driven = std::min(gap.elapsed, kLongestCarried);
  const Pose2 carried{linear_ * driven, 0.0, Angle::radians(angular_ * driven)};
  odom_from_raw_before_ = odom_from_raw_;
  odom_from_raw_ = odom_from_raw_ * raw_from_base_ * carried * inverse(raw_from_base);
  jumped_ = stamp;
}

UnbrokenOdometry::Reading UnbrokenOdometry::add(Time stamp, const Pose2& raw_from_base) {
  if (!stamp_) {
    stamp_ = changed_ = stamp;
    raw_from_base_ = raw_from_base;
    return {odom_from_raw_ * raw_from_base_};
  }
  const bool repeats = is_same(raw_from_base, raw_from_base_);
  const bool is_double = stamp == *stamp_ && repeats;
  if (is_double || !counts(stamp)) return {.odom_from_base = odom_from_raw_ * raw_from_base_, .is_late = true};
  const bool is_set_back = stamp < *stamp_;
  const Gap gap = gap_to(stamp, is_set_back);
  if (is_set_back) {
    changed_ = std::min(changed_, stamp);
    jumped_ = std::min(jumped_, stamp);
  } else {
    learn(to_seconds(stamp - *stamp_));
  }
  late_ = rising_ = 0;
  stamp_ = stamp;
  const bool is_frozen = repeats && in_full_drive() && stamp - changed_ < seconds(params_.longest_frozen);
  if (is_frozen) return {.odom_from_base = odom_from_raw_ * raw_from_base_, .is_set_back = is_set_back};
  const Pose2 motion = inverse(raw_from_base_) * raw_from_base;
  const bool jumped = is_jump(gap, raw_from_base, motion);
  if (jumped) {
    leave_out_step(stamp, gap, raw_from_base);
  } else if (gap.elapsed > 0.0) {
    linear_ = std::copysign(norm(motion.position()), motion.x) / gap.elapsed;
    angular_ = motion.theta.radians() / gap.elapsed;
  }
  changed_ = stamp;
  raw_from_base_ = raw_from_base;
  return {odom_from_raw_ * raw_from_base_, jumped, false, is_set_back};
}

const Pose2& UnbrokenOdometry::odom_from_raw(Time stamp) const {
  return stamp < jumped_ ? odom_from_raw_before_ : odom_from_raw_;
}

}  // namespace docent::motion_models
