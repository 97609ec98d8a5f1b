#include "docent/modules/exploration/keyframes.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace docent::modules {

Result<void> KeyframeParams::validate() const {
  if (!(way > 0.0)) return fail("way must be > 0 m");
  if (!(turn > 0.0)) return fail("turn must be > 0 degrees");
  if (!(pause > 0.0)) return fail("pause must be > 0 s");
  if (!(together > 0.0)) return fail("together must be > 0 s");
  if (!(person >= 0.0)) return fail("person must be >= 0 m");
  return {};
}

Keyframes::Keyframes(const KeyframeParams& params, const mapping::PointSweepParams& points,
                     const std::vector<robot::Scanner>& scanners)
    : params_{params}, points_{points}, base_from_laser_{mounts_of(scanners)}, newest_(scanners.size()) {}

void Keyframes::keep(std::size_t laser, const sensor_msgs::LaserScan& scan) { newest_[laser] = scan; }

sensor_models::LaserReading Keyframes::reading(std::size_t laser) const {
  const sensor_msgs::LaserScan& scan = newest_[laser];
  return {scan.ranges, Angle::radians(scan.angle_min), scan.angle_increment, scan.range_min, scan.range_max};
}

std::vector<std::optional<Pose2>> Keyframes::bases(const PoseTracker& pose) const {
  std::vector<std::optional<Pose2>> result(newest_.size());
  for (std::size_t laser = 0; laser < newest_.size(); ++laser) {
    if (newest_[laser].ranges.empty()) continue;
    const Time then = from_message(newest_[laser].header.stamp);
    const double apart = std::abs(to_seconds(from_message(newest_.front().header.stamp) - then));
    if (apart <= params_.together) result[laser] = pose.odom_from_base_at(then);
  }
  return result;
}

std::optional<Keyframes::Look> Keyframes::look(const PoseTracker& pose) const {
  const auto odom_from_then = bases(pose);
  if (odom_from_then.empty() || !odom_from_then.front()) return std::nullopt;
  Look result{from_message(newest_.front().header.stamp), *odom_from_then.front(), {}};
  for (std::size_t laser = 0; laser < newest_.size(); ++laser) {
    if (!odom_from_then[laser]) continue;
    const Pose2 base_from_laser = inverse(result.odom_from_base) * *odom_from_then[laser] * base_from_laser_[laser];
    append(result.sweep, reading(laser), base_from_laser);
  }
  return result;
}

std::optional<Keyframe> Keyframes::take(const PoseTracker& pose, std::span<const Point2> people) {
  const auto odom_from_then = bases(pose);
  if (odom_from_then.empty() || !odom_from_then.front()) return std::nullopt;
  const Time stamp = from_message(newest_.front().header.stamp);
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

}  // namespace docent::modules
