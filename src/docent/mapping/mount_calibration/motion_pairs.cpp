#include "docent/mapping/mount_calibration/motion_pairs.h"

#include <algorithm>
#include <cmath>

namespace docent::mapping {

std::optional<ShiftedMotion> ShiftedMotion::between(const motion_models::OdometryHistory& odometry, Time from,
                                                    Time to) {
  ShiftedMotion result;
  for (int i = 0; i < kShifts; ++i) {
    const Duration shift = seconds(i * kStep - kMost);
    const auto then = odometry.at(from - shift, Duration{});
    const auto now = odometry.at(to - shift, Duration{});
    if (!then || !now) return std::nullopt;
    result.motions_[static_cast<std::size_t>(i)] = inverse(*then) * *now;
  }
  return result;
}

Pose2 ShiftedMotion::at(double delay) const {
  const double place = std::clamp((delay + kMost) / kStep, 0.0, static_cast<double>(kShifts - 1));
  const auto before = std::min(static_cast<std::size_t>(place), static_cast<std::size_t>(kShifts - 2));
  const double share = place - static_cast<double>(before);
  const Pose2& a = motions_[before];
  const Pose2& b = motions_[before + 1];
  return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y),
          a.theta + Angle::radians(share * (b.theta - a.theta).radians())};
}

ShiftedMotion ShiftedMotion::constant(const Pose2& motion) {
  ShiftedMotion result;
  result.motions_.fill(motion);
  return result;
}

}  // namespace docent::mapping
