#include "docent/motion_models/unbroken_odometry.h"

#include <algorithm>
#include <cmath>

namespace docent::motion_models {

namespace {

constexpr double kInFullDrive = 0.1;      // [m/s], [rad/s]: no base stands from it within one reading
constexpr double kShortest = 0.005;       // [s] between two readings that tell a velocity
constexpr double kLongestFrozen = 3.0;    // [s] the robot may have driven on meanwhile
constexpr double kLinearChange = 4.0;     // [m/s2]
constexpr double kAngularChange = 10.0;   // [rad/s2]
constexpr double kLinearNoise = 0.06;     // [m]
constexpr double kAngularNoise = 0.0873;  // [rad]

bool is_same(const Pose2& a, const Pose2& b) {
  return a.x == b.x && a.y == b.y && a.theta.radians() == b.theta.radians();
}

}  // namespace

bool UnbrokenOdometry::is_jump(double dt, const Pose2& motion) const {
  const double square = 0.5 * dt * dt;
  const Point2 carried{linear_ * dt, 0.0};
  return distance(motion.position(), carried) > kLinearNoise + kLinearChange * square ||
         std::abs(motion.theta.radians() - angular_ * dt) > kAngularNoise + kAngularChange * square;
}

void UnbrokenOdometry::follow(double dt, const Pose2& motion) {
  linear_ = std::copysign(norm(motion.position()), motion.x) / dt;
  angular_ = motion.theta.radians() / dt;
}

UnbrokenOdometry::Reading UnbrokenOdometry::add(Time stamp, const Pose2& raw_from_base) {
  if (!stamp_ || *stamp_ - stamp >= seconds(1.0)) {
    stamp_ = changed_ = stamp;
    raw_from_base_ = raw_from_base;
    linear_ = angular_ = 0.0;
    return {odom_from_raw_ * raw_from_base_, false};
  }
  if (to_seconds(stamp - *stamp_) < kShortest) return {odom_from_raw_ * raw_from_base_, false};
  const Pose2 motion = inverse(raw_from_base_) * raw_from_base;
  const bool in_full_drive = std::abs(linear_) > kInFullDrive || std::abs(angular_) > kInFullDrive;
  const bool frozen =
      is_same(raw_from_base, raw_from_base_) && in_full_drive && stamp - changed_ < seconds(kLongestFrozen);
  const double dt = std::max(kShortest, to_seconds(stamp - (in_full_drive ? changed_ : *stamp_)));
  stamp_ = stamp;
  if (frozen) return {odom_from_raw_ * raw_from_base_, false};
  changed_ = stamp;
  const bool jumped = is_jump(dt, motion);
  if (jumped) {
    const Angle turn = Angle::radians(angular_ * dt);
    const Pose2 carried{linear_ * dt, 0.0, turn};
    odom_from_raw_before_ = odom_from_raw_;
    odom_from_raw_ = odom_from_raw_ * raw_from_base_ * carried * inverse(raw_from_base);
    jumped_ = stamp;
  } else {
    follow(dt, motion);
  }
  raw_from_base_ = raw_from_base;
  return {odom_from_raw_ * raw_from_base_, jumped};
}

const Pose2& UnbrokenOdometry::odom_from_raw(Time stamp) const {
  return stamp < jumped_ ? odom_from_raw_before_ : odom_from_raw_;
}

}  // namespace docent::motion_models
