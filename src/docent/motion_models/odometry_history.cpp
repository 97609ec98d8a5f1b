#include "docent/motion_models/odometry_history.h"

#include <algorithm>

namespace docent::motion_models {

void OdometryHistory::add(Time time, const Pose2& odom_from_robot) {
  if (!readings_.empty() && time <= readings_.back().time) {
    if (time == readings_.back().time) readings_.back().odom_from_robot = odom_from_robot;  // the newest of a burst
    if (readings_.back().time - time < std::chrono::seconds{2}) return;                     // late or doubled
    readings_.clear();  // a stamp was wrong, or the clock was set
  }
  readings_.push_back({time, odom_from_robot});
  while (readings_.size() > 1 && time - readings_.front().time > kept_) readings_.pop_front();
}

std::optional<Pose2> OdometryHistory::at(Time time, Duration ahead) const {
  if (readings_.empty() || time < readings_.front().time || time - readings_.back().time > ahead) return std::nullopt;
  const auto after = std::lower_bound(readings_.begin(), readings_.end(), time,
                                      [](const Reading& reading, Time t) { return reading.time < t; });
  if (after == readings_.end()) return readings_.back().odom_from_robot;
  if (after == readings_.begin()) return after->odom_from_robot;
  const Reading& before = *(after - 1);
  const double share = to_seconds(time - before.time) / to_seconds(after->time - before.time);
  const Pose2& a = before.odom_from_robot;
  const Pose2& b = after->odom_from_robot;
  const double turn = (b.theta - a.theta).radians();
  return Pose2{a.x + share * (b.x - a.x), a.y + share * (b.y - a.y), a.theta + Angle::radians(share * turn)};
}

}  // namespace docent::motion_models
