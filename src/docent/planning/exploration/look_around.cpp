#include "docent/planning/exploration/look_around.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "docent/planning/exploration/tell_apart.h"

namespace docent::planning {
namespace {

constexpr double kNeeded = 1.3;        ///< [m] of free way that makes a drive worthwhile
constexpr double kKeepOff = 0.7;       ///< [m] left free at its end
constexpr double kLongestDrive = 2.0;  ///< [m]
constexpr double kPhaseLimit = 20.0;   ///< [s]
constexpr double kThere = 0.3;         ///< [m] from the end of a drive
constexpr double kAskAgain = 1.0;      ///< [s]
constexpr double kProgress = 0.1;      ///< [m] nearer to the end of a drive
constexpr double kHeldUp = 9.0;        ///< [s] without: the horn and a word had their time

}  // namespace

void LookAround::start(Time now) {
  phase_ = Phase::turning;
  turned_ = 0.0;
  last_heading_.reset();
  aim_.reset();
  phase_start_ = now;
}

LookAroundStep LookAround::drive_to(const Pose2& odom_from_base, Point2 in_base, Time now) {
  aim_ = odom_from_base * in_base;
  nearest_ = norm(in_base);
  phase_ = Phase::driving;
  phase_start_ = nearer_since_ = now;
  return {true, *aim_, {}};
}

double LookAround::held_up_s(Time now) const {
  return phase_ == Phase::driving ? to_seconds(now - nearer_since_) : 0.0;
}

LookAroundStep LookAround::turn_on(const Pose2& odom_from_base) {
  return {false, {}, odom_from_base.theta + Angle::degrees(100)};
}

LookAroundStep LookAround::step(const Pose2& odom_from_base, std::span<const double> clearances,
                                const std::function<std::optional<Point2>()>& telling, Time now) {
  const double phase_s = to_seconds(now - phase_start_);
  if (phase_ == Phase::driving) {
    const double left = distance(odom_from_base.position(), *aim_);
    if (left < nearest_ - kProgress) {
      nearest_ = left;
      nearer_since_ = now;
    }
    if (left >= kThere && phase_s <= kPhaseLimit && held_up_s(now) < kHeldUp) return {true, *aim_, {}};
    start(now);
  }
  if (last_heading_) turned_ += (odom_from_base.theta - *last_heading_).radians();
  last_heading_ = odom_from_base.theta;
  if (!clearances.empty() && (!asked_ || to_seconds(now - *asked_) >= kAskAgain)) {
    asked_ = now;
    if (const auto place = telling()) return drive_to(odom_from_base, *place, now);
  }
  if (turned_ <= 2.0 * std::numbers::pi && phase_s <= kPhaseLimit) return turn_on(odom_from_base);
  if (!clearances.empty()) {
    int best = 0;
    for (int i = 1; i < static_cast<int>(clearances.size()); ++i) {
      if (clearance_of_cone(clearances, i) > clearance_of_cone(clearances, best)) best = i;
    }
    const double free = clearance_of_cone(clearances, best);
    if (free >= kNeeded) {
      const Angle bearing = Angle::degrees(-180.0 + 360.0 * best / static_cast<double>(clearances.size()));
      return drive_to(odom_from_base, std::min(free - kKeepOff, kLongestDrive) * unit(bearing), now);
    }
  }
  start(now);
  return turn_on(odom_from_base);
}

}  // namespace docent::planning
