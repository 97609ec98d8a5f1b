#include "docent/apps/localize/map_poses.h"

#include <algorithm>
#include <cmath>

#include "docent/apps/localize/localize_log.h"

namespace docent::apps::localize_command {
namespace {

constexpr double kTogether = 0.15;  // [s] between scans of two lasers that are of one moment

Pose2 part_of(const Pose2& motion, double share) {
  return {share * motion.x, share * motion.y, Angle::radians(share * motion.theta.radians())};
}

/// The points of a scan as the robot's base saw them from `odom_from_base`.
void append_points(const recording::LoggedScan& scan, double max_range, const Pose2& odom_from_base,
                   const mapping::PointSweepParams& params, mapping::MappingScan& out) {
  const Pose2 base_from_laser = inverse(odom_from_base) * scan.odom_from_base * scan.base_from_laser;
  for (const mapping::SurfacePoint& point : surface_points(sweep_of(scan, max_range), params)) {
    out.points.push_back(transformed(base_from_laser, point));
  }
  out.sensors.push_back(base_from_laser.position());
}

}  // namespace

ChosenScans choose_scans(const recording::LaserLog& log, const mapping::ScanChoiceParams& params,
                         const mapping::PointSweepParams& points) {
  ChosenScans chosen;
  const bool two = has_two_lasers(log);
  mapping::ScanChoice choice{params};
  for (std::size_t i = 0; i < log.scans.size(); ++i) {
    const recording::LoggedScan& scan = log.scans[i];
    if ((two && scan.rear) || !choice.takes(scan.odom_from_base)) continue;
    mapping::MappingScan taken;
    taken.odom_from_base = scan.odom_from_base;
    append_points(scan, log.max_range, scan.odom_from_base, points, taken);
    for (std::size_t k = i > 3 ? i - 3 : 0; two && k < std::min(log.scans.size(), i + 4); ++k) {
      const recording::LoggedScan& other = log.scans[k];
      if (!other.rear || std::abs(to_seconds(other.time - scan.time)) > kTogether) continue;
      append_points(other, log.max_range, scan.odom_from_base, points, taken);
      chosen.sources.push_back(k);
      break;
    }
    chosen.scans.push_back(std::move(taken));
    chosen.indices.push_back(i);
    chosen.sources.push_back(i);
  }
  return chosen;
}

std::vector<Pose2> poses_of_all(const recording::LaserLog& log, std::span<const std::size_t> indices,
                                std::span<const Pose2> map_from_base) {
  std::vector<Pose2> poses(log.scans.size());
  std::size_t n = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    while (n + 1 < indices.size() && indices[n + 1] <= i) ++n;
    const auto carried = [&](std::size_t to) {
      return map_from_base[n] * (inverse(log.scans[indices[n]].odom_from_base) * log.scans[to].odom_from_base);
    };
    poses[i] = carried(i);
    if (n + 1 >= indices.size()) continue;
    const std::size_t next = indices[n + 1];
    const double before =
        distance(log.scans[indices[n]].odom_from_base.position(), log.scans[i].odom_from_base.position());
    const double after = distance(log.scans[next].odom_from_base.position(), log.scans[i].odom_from_base.position());
    if (before + after > 0.0) {
      poses[i] = poses[i] * part_of(inverse(carried(next)) * map_from_base[n + 1], before / (before + after));
    }
  }
  return poses;
}

}  // namespace docent::apps::localize_command
