#include "docent/modules/exploration/keyframes.h"

#include <cmath>
#include <utility>

namespace docent::modules {

Result<void> KeyframeParams::validate() const {
  if (!(way > 0.0)) return fail("way must be > 0 m");
  if (!(turn > 0.0)) return fail("turn must be > 0 degrees");
  if (!(pause > 0.0)) return fail("pause must be > 0 s");
  if (!(together > 0.0)) return fail("together must be > 0 s");
  return {};
}

Keyframes::Keyframes(const KeyframeParams& params, const mapping::PointSweepParams& points,
                     const std::vector<robot::Scanner>& scanners)
    : params_{params}, points_{points}, base_from_laser_{mounts_of(scanners)}, newest_(scanners.size()) {}

void Keyframes::keep(std::size_t laser, const sensor_msgs::LaserScan& scan) { newest_[laser] = scan; }

void Keyframes::append(std::size_t laser, const Pose2& odom_from_base, const Pose2& odom_from_then,
                       Keyframe& frame) const {
  const sensor_msgs::LaserScan& scan = newest_[laser];
  const sensor_models::LaserReading reading{scan.ranges, Angle::radians(scan.angle_min), scan.angle_increment,
                                            scan.range_min, scan.range_max};
  mapping::MountedSweep mounted{{}, inverse(odom_from_base) * odom_from_then * base_from_laser_[laser]};
  sensor_models::append(mounted.sweep, reading, Pose2{});
  for (const mapping::SurfacePoint& point : surface_points(mounted.sweep, points_))
    frame.scan.points.push_back(transformed(mounted.base_from_sensor, point));
  frame.scan.sensors.push_back(mounted.base_from_sensor.position());
  frame.sweeps.push_back(std::move(mounted));
}

std::optional<Keyframe> Keyframes::take(const PoseTracker& pose) {
  if (newest_.empty() || newest_.front().ranges.empty()) return std::nullopt;
  const Time stamp = from_message(newest_.front().header.stamp);
  const auto odom_from_base = pose.odom_from_base_at(stamp);
  if (!odom_from_base) return std::nullopt;
  if (last_) {
    const Pose2 moved = inverse(*last_) * *odom_from_base;
    const bool has_moved = norm(moved.position()) >= params_.way || std::abs(moved.theta.degrees()) >= params_.turn;
    if (!has_moved && stamp - last_stamp_ < seconds(params_.pause)) return std::nullopt;
  }
  Keyframe frame{stamp, {*odom_from_base, {}, {}}, {}};
  for (std::size_t laser = 0; laser < newest_.size(); ++laser) {
    if (newest_[laser].ranges.empty()) return std::nullopt;
    const Time then = from_message(newest_[laser].header.stamp);
    const auto odom_from_then = pose.odom_from_base_at(then);
    if (!odom_from_then || std::abs(to_seconds(stamp - then)) > params_.together) {
      if (!last_) return std::nullopt;  // the map begins with all lasers
      continue;
    }
    append(laser, *odom_from_base, *odom_from_then, frame);
  }
  last_ = odom_from_base;
  last_stamp_ = stamp;
  return frame;
}

}  // namespace docent::modules
