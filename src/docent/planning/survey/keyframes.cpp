#include "docent/planning/survey/keyframes.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace docent::planning {

Result<void> KeyframeParams::validate() const {
  if (!(way > 0.0)) return fail("way must be > 0 m");
  if (!(turn > 0.0)) return fail("turn must be > 0 degrees");
  if (!(pause > 0.0)) return fail("pause must be > 0 s");
  if (!(together > 0.0)) return fail("together must be > 0 s");
  if (!(person >= 0.0)) return fail("person must be >= 0 m");
  return {};
}

Keyframes::Keyframes(const KeyframeParams& params, const mapping::PointSweepParams& points,
                     std::vector<Pose2> base_from_laser)
    : params_{params},
      points_{points},
      base_from_laser_{std::move(base_from_laser)},
      newest_(base_from_laser_.size()) {}

void Keyframes::keep(std::size_t laser, Time stamp, const sensor_models::LaserReading& reading) {
  Newest& newest = newest_[laser];
  newest.stamp = stamp;
  newest.reading = reading;
  newest.reading.ranges = {};
  newest.ranges.assign(reading.ranges.begin(), reading.ranges.end());
}

sensor_models::LaserReading Keyframes::reading(std::size_t laser) const {
  sensor_models::LaserReading reading = newest_[laser].reading;
  reading.ranges = newest_[laser].ranges;
  return reading;
}

std::vector<std::optional<Pose2>> Keyframes::bases(const collision_avoidance::BaseHistory& odometry) const {
  std::vector<std::optional<Pose2>> result(newest_.size());
  for (std::size_t laser = 0; laser < newest_.size(); ++laser) {
    if (newest_[laser].ranges.empty()) continue;
    const Time then = newest_[laser].stamp;
    const double apart = std::abs(to_seconds(newest_.front().stamp - then));
    if (apart <= params_.together && !odometry.empty()) result[laser] = odometry.pose_at(then);
  }
  return result;
}

std::optional<Keyframes::Look> Keyframes::look(const collision_avoidance::BaseHistory& odometry) const {
  const auto odom_from_then = bases(odometry);
  if (odom_from_then.empty() || !odom_from_then.front()) return std::nullopt;
  Look result{newest_.front().stamp, *odom_from_then.front(), {}};
  for (std::size_t laser = 0; laser < newest_.size(); ++laser) {
    if (!odom_from_then[laser]) continue;
    const Pose2 base_from_laser = inverse(result.odom_from_base) * *odom_from_then[laser] * base_from_laser_[laser];
    append(result.sweep, reading(laser), base_from_laser);
  }
  return result;
}

std::optional<Keyframe> Keyframes::take(const collision_avoidance::BaseHistory& odometry,
                                        std::span<const Point2> people) {
  const auto odom_from_then = bases(odometry);
  if (odom_from_then.empty() || !odom_from_then.front()) return std::nullopt;
  const Time stamp = newest_.front().stamp;
  const Pose2 odom_from_base = *odom_from_then.front();
  if (last_) {
    const Pose2 moved = inverse(*last_) * odom_from_base;
    const bool has_moved = norm(moved.position()) >= params_.way || std::abs(moved.theta.degrees()) >= params_.turn;
    if (!has_moved && stamp - last_stamp_ < seconds(params_.pause)) return std::nullopt;
  } else if (std::any_of(odom_from_then.begin(), odom_from_then.end(), [](const auto& base) { return !base; })) {
    return std::nullopt;  // the map begins with all lasers
  }
  Keyframe frame{stamp, {odom_from_base, {}, {}}, {}};
  for (std::size_t laser = 0; laser < newest_.size(); ++laser) {
    if (!odom_from_then[laser]) continue;
    const Pose2 odom_from_laser = *odom_from_then[laser] * base_from_laser_[laser];
    mapping::MountedSweep mounted{{}, inverse(odom_from_base) * odom_from_laser};
    append(mounted.sweep, reading(laser), Pose2{});
    std::erase_if(mounted.sweep.beams, [&](const sensor_models::SweepBeam& beam) {
      if (beam.no_return) return false;
      const Point2 end = odom_from_laser * endpoint(beam);
      return std::any_of(people.begin(), people.end(),
                         [&](Point2 person) { return distance(person, end) < params_.person; });
    });
    for (const mapping::SurfacePoint& point : surface_points(mounted.sweep, points_))
      frame.scan.points.push_back(transformed(mounted.base_from_sensor, point));
    frame.scan.sensors.push_back(mounted.base_from_sensor.position());
    frame.sweeps.push_back(std::move(mounted));
  }
  last_ = odom_from_base;
  last_stamp_ = stamp;
  return frame;
}

}  // namespace docent::planning
