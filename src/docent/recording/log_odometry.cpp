#include "docent/recording/log_odometry.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>

namespace docent::recording {
namespace {

motion_models::UnbrokenOdometryParams of_log(bool times_are_true) {
  motion_models::UnbrokenOdometryParams params{.base = motion_models::BaseReach::of_any()};
  if (!times_are_true) params.margin = 1e9;
  return params;
}

/// @param share  of the way from `a` to `b`; above 1 beyond `b`
Pose2 between(const LoggedOdometry& from, const LoggedOdometry& to, double share) {
  const Pose2& a = from.odom_from_base;
  const Pose2& b = to.odom_from_base;
  return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y),
          Angle::radians(a.theta.radians() + share * (b.theta - a.theta).radians())};
}

/// Outside of all readings. @param end  the first or the last one, @param next  its neighbour
Pose2 beyond(const LoggedOdometry& end, const LoggedOdometry& next, Time time) {
  constexpr double kMost = 0.2;  // [s]
  const double apart = std::abs(to_seconds(end.time - next.time));
  if (!(apart > 0.0)) return end.odom_from_base;
  const double gone = std::min({std::abs(to_seconds(time - end.time)), apart, kMost});
  return between(next, end, 1.0 + gone / apart);
}

}  // namespace

Time RisingStamps::follow(Time stamp) {
  const Time moved = stamp + shift_;
  if (is_first_ || moved >= newest_) {
    is_first_ = false;
    rising_ = 0;
    return newest_ = moved;
  }
  const Duration interval = stamp - late_;
  rising_ = rising_ > 0 && interval.count() > 0 ? rising_ + 1 : 1;
  late_ = stamp;
  if (rising_ < kEnough) return moved;
  ++set_back_;
  rising_ = 0;
  newest_ = newest_ + kEnough * interval;  // as long as these took to come
  shift_ = newest_ - stamp;
  return newest_;
}

Pose2 odometry_at(const LaserLog& log, Time time) {
  const auto& readings = log.odometry;
  if (readings.empty()) return {};
  const auto after = std::lower_bound(readings.begin(), readings.end(), time,
                                      [](const LoggedOdometry& reading, Time wanted) { return reading.time < wanted; });
  if (after == readings.begin()) return beyond(readings.front(), readings[readings.size() > 1 ? 1 : 0], time);
  if (after == readings.end())
    return beyond(readings.back(), readings[readings.size() > 1 ? readings.size() - 2 : 0], time);
  const LoggedOdometry& before = *std::prev(after);
  return between(before, *after, to_seconds(time - before.time) / to_seconds(after->time - before.time));
}

LogOdometry::LogOdometry(bool times_are_true) : unbroken_{of_log(times_are_true)} {}

std::optional<Pose2> LogOdometry::follow(Time time, const Pose2& raw_from_base) {
  if (!begins_) begins_ = time;
  const auto reading = unbroken_.add(time, raw_from_base);
  if (reading.is_late) return std::nullopt;
  if (reading.jumped && ++jumps_ == 1) first_jump_ = time;
  return reading.odom_from_base;
}

Pose2 LogOdometry::follow_scan(Time time, const Pose2& raw_from_base) {
  return follow(time, raw_from_base).value_or(unbroken_.odom_from_raw(time) * raw_from_base);
}

std::string LogOdometry::note() const {
  if (jumps_ == 0) return {};
  return "the odometry jumped " + (jumps_ == 1 ? std::string{"once"} : std::to_string(jumps_) + " times, first") +
         ", " + std::to_string(std::lround(to_seconds(first_jump_ - *begins_))) +
         " s after it began: such a step is taken for no motion";
}

}  // namespace docent::recording
