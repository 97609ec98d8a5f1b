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
  if (after == readings.begin()) return after->odom_from_base;
  if (after == readings.end()) return readings.back().odom_from_base;
  const LoggedOdometry& before = *std::prev(after);
  const double share = to_seconds(time - before.time) / to_seconds(after->time - before.time);
  const Pose2& a = before.odom_from_base;
  const Pose2& b = after->odom_from_base;
  return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y),
          Angle::radians(a.theta.radians() + share * (b.theta - a.theta).radians())};
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
