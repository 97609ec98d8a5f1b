#include "docent/localization/pose_watch/sweep_joiner.h"

#include <algorithm>
#include <utility>

namespace docent::localization {

SweepJoiner::SweepJoiner(const std::vector<Pose2>& base_from_laser) : lasers_(base_from_laser.size()) {
  for (std::size_t i = 0; i < lasers_.size(); ++i) lasers_[i].base_from_laser = base_from_laser[i];
}

void SweepJoiner::keep(std::size_t laser, Time stamp, const sensor_models::LaserReading& reading) {
  Laser& kept = lasers_[laser];
  const bool is_double = stamp == kept.stamp && std::equal(reading.ranges.begin(), reading.ranges.end(),
                                                           kept.ranges.begin(), kept.ranges.end());
  if (is_double) return;
  kept.stamp = stamp;
  kept.reading = reading;
  kept.reading.ranges = {};
  kept.ranges.assign(reading.ranges.begin(), reading.ranges.end());
  kept.is_new = true;
}

bool SweepJoiner::has_new() const {
  return std::any_of(lasers_.begin(), lasers_.end(), [](const Laser& laser) { return laser.is_new; });
}

Time SweepJoiner::newest() const {
  Time newest{};
  for (const Laser& laser : lasers_)
    if (laser.is_new) newest = std::max(newest, laser.stamp);
  return newest;
}

std::optional<SweepJoiner::Joined> SweepJoiner::join(const OdometryTrail& odometry) {
  if (!has_new()) return std::nullopt;
  Joined joined;
  joined.stamp = newest();
  const auto odom_from_base = odometry.at(joined.stamp);
  if (!odom_from_base) return std::nullopt;  // wait for odometry, or the scan is too old to be placed
  joined.odom_from_base = *odom_from_base;
  for (Laser& laser : lasers_) {
    const auto then = odometry.at(laser.stamp);
    const Duration together = std::exchange(laser.is_new, false) ? kNewTogether : kTogether;
    if (laser.ranges.empty() || joined.stamp - laser.stamp > together || !then) continue;
    const Pose2 base_from_then = inverse(*odom_from_base) * *then;
    sensor_models::LaserReading reading = laser.reading;
    reading.ranges = laser.ranges;
    sensor_models::append(joined.sweep, reading, base_from_then * laser.base_from_laser);
  }
  if (joined.sweep.beams.empty()) return std::nullopt;
  return joined;
}

}  // namespace docent::localization
