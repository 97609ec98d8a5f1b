#include "docent/planning/exploration/look_around.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "docent/planning/exploration/tell_apart.h"

namespace docent::planning {
namespace {

/// A drive: so much free way makes it worthwhile, and so much of it is left at its end.
struct Room {
  double needed;    ///< [m]
  double keep_off;  ///< [m]
};
/// The wider the better; the robot's own half, its margins and braking lie within the least.
constexpr std::array<Room, 3> kRooms{{{1.3, 0.7}, {0.95, 0.55}, {0.7, 0.42}}};
constexpr double kLongestDrive = 2.0;  ///< [m]
constexpr double kPhaseLimit = 20.0;   ///< [s]
constexpr double kThere = 0.3;         ///< [m] from the end of a long drive,
constexpr double kThereShare = 0.35;   ///< of its length, from that of a short one
constexpr double kAskAgain = 1.0;      ///< [s]
constexpr double kProgress = 0.1;      ///< [m] nearer to the end of a drive
constexpr double kHeldUp = 9.0;        ///< [s] without: the horn and a word had their time
constexpr double kBackWorth = 0.5;     ///< of the free way that leads back to where the last drive began,
constexpr double kBack = 60.0;         ///< [deg] from that direction

}  // namespace

void LookAround::start(Time now) {
  turn_anew(now);
  hemmed_in_since_.reset();
  left_.reset();
}

void LookAround::turn_anew(Time now) {
  phase_ = Phase::turning;
  turned_ = 0.0;
  last_heading_.reset();
  aim_.reset();
  phase_start_ = now;
}

LookAroundStep LookAround::drive_to(const Pose2& odom_from_base, Point2 in_base, Time now) {
  aim_ = odom_from_base * in_base;
  left_ = odom_from_base.position();
  nearest_ = norm(in_base);
  tolerance_ = std::min(0.25, kThereShare * nearest_);
  phase_ = Phase::driving;
  phase_start_ = nearer_since_ = now;
  hemmed_in_since_.reset();
  return drive_on();
}

double LookAround::held_up_s(Time now) const {
  if (phase_ == Phase::driving) return to_seconds(now - nearer_since_);
  return hemmed_in_since_ ? to_seconds(now - *hemmed_in_since_) : 0.0;
}

LookAroundStep LookAround::turn_on(const Pose2& odom_from_base) {
  return {false, {}, odom_from_base.theta + Angle::degrees(100)};
}

std::optional<Point2> LookAround::free_place(const Pose2& odom_from_base, std::span<const double> clearances) const {
  if (clearances.empty()) return std::nullopt;
  const auto bearing_of = [&](int i) {
    return Angle::degrees(-180.0 + 360.0 * i / static_cast<double>(clearances.size()));
  };
  std::optional<Angle> back;
  if (left_ && distance(*left_, odom_from_base.position()) > kProgress)
    back = direction(odom_from_base.position(), *left_) - odom_from_base.theta;
  int best = 0;
  double most = 0.0;
  for (int i = 0; i < static_cast<int>(clearances.size()); ++i) {
    const bool leads_back = back && std::abs((bearing_of(i) - *back).degrees()) < kBack;
    const double worth = clearance_of_cone(clearances, i) * (leads_back ? kBackWorth : 1.0);
    if (worth <= most) continue;
    most = worth;
    best = i;
  }
  const double free = clearance_of_cone(clearances, best);
  for (const Room& room : kRooms)
    if (free >= room.needed) return std::min(free - room.keep_off, kLongestDrive) * unit(bearing_of(best));
  return std::nullopt;
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
    const double there = std::min(kThere, tolerance_ + 0.05);
    if (left >= there && phase_s <= kPhaseLimit && held_up_s(now) < kHeldUp) return drive_on();
    turn_anew(now);
  }
  if (last_heading_) turned_ += (odom_from_base.theta - *last_heading_).radians();
  last_heading_ = odom_from_base.theta;
  if (!clearances.empty() && (!asked_ || to_seconds(now - *asked_) >= kAskAgain)) {
    asked_ = now;
    if (const auto place = telling()) return drive_to(odom_from_base, *place, now);
  }
  if (turned_ <= 2.0 * std::numbers::pi && phase_s <= kPhaseLimit) return turn_on(odom_from_base);
  if (const auto place = free_place(odom_from_base, clearances)) return drive_to(odom_from_base, *place, now);
  if (!hemmed_in_since_) hemmed_in_since_ = now;
  turn_anew(now);
  return turn_on(odom_from_base);
}

}  // namespace docent::planning
