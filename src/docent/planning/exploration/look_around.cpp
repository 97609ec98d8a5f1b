#include "docent/planning/exploration/look_around.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace docent {
namespace {

constexpr double kNeeded = 1.3;        ///< [m] of free way that makes a drive worthwhile
constexpr double kKeepOff = 0.7;       ///< [m] left free at its end
constexpr double kLongestDrive = 2.0;  ///< [m]
constexpr double kPhaseLimit = 20.0;   ///< [s]

/// The least clearance within 20 degrees of direction `index`: the robot is wider than a beam.
double clearance_of_cone(std::span<const double> clearances, int index) {
  const int count = static_cast<int>(clearances.size());
  const int spread = count * 20 / 360;
  double least = clearances[static_cast<std::size_t>(index)];
  for (int k = -spread; k <= spread; ++k) {
    least = std::min(least, clearances[static_cast<std::size_t>((index + k + count) % count)]);
  }
  return least;
}

}  // namespace

void LookAround::start(Time now) {
  phase_ = Phase::turning;
  turned_ = 0.0;
  last_heading_.reset();
  aim_.reset();
  phase_start_ = now;
}

LookAroundStep LookAround::step(const Pose2& odom_from_base, std::span<const double> clearances, Time now) {
  const double phase_s = to_seconds(now - phase_start_);
  if (phase_ == Phase::turning) {
    if (last_heading_) turned_ += (odom_from_base.theta - *last_heading_).radians();
    last_heading_ = odom_from_base.theta;
    const bool is_done = turned_ > 2.0 * std::numbers::pi || phase_s > kPhaseLimit;
    if (is_done && !clearances.empty()) {
      int best = 0;
      for (int i = 1; i < static_cast<int>(clearances.size()); ++i) {
        if (clearance_of_cone(clearances, i) > clearance_of_cone(clearances, best)) best = i;
      }
      const double free = clearance_of_cone(clearances, best);
      if (free >= kNeeded) {
        const Angle bearing = Angle::degrees(-180.0 + 360.0 * best / static_cast<double>(clearances.size()));
        aim_ = odom_from_base * (std::min(free - kKeepOff, kLongestDrive) * unit(bearing));
        phase_ = Phase::driving;
        phase_start_ = now;
        return {true, *aim_, {}};
      }
    }
    if (is_done) start(now);
    return {false, {}, odom_from_base.theta + Angle::degrees(100)};
  }
  if (!aim_ || distance(odom_from_base.position(), *aim_) < 0.3 || phase_s > kPhaseLimit) {
    start(now);
    return {false, {}, odom_from_base.theta + Angle::degrees(100)};
  }
  return {true, *aim_, {}};
}

}  // namespace docent
