#include "docent/apps/localize/scan_odometry.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "docent/apps/localize/localize_log.h"

namespace docent::apps::localize_command {
namespace {

constexpr double kStill = 1e-3;  // [m, rad]

mapping::MappingScan seen_by(const recording::LoggedScan& scan, double max_range,
                             const mapping::PointSweepParams& params) {
  mapping::MappingScan seen;
  for (const mapping::SurfacePoint& point : surface_points(sweep_of(scan, max_range), params))
    seen.points.push_back(transformed(scan.base_from_laser, point));
  seen.sensors.push_back(scan.base_from_laser.position());
  return seen;
}

/// The motion of `seconds` by one of `seconds_before`.
Pose2 gone_on(const Pose2& step, double seconds_before, double seconds, double longest) {
  if (!(seconds_before > 0.0) || !(seconds > 0.0) || seconds > longest) return {};
  const double share = std::min(seconds / seconds_before, 3.0);
  return {share * step.x, share * step.y, Angle::radians(share * step.theta.radians())};
}

/// [m] by which the match alone, without what was expected, leaves its most uncertain direction open.
double widest(const mapping::ChainStep& step, const mapping::ChainStep& expected) {
  const Eigen::Matrix2d information = (step.information - expected.information).topLeftCorner<2, 2>();
  const double least = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>{information}.eigenvalues()(0);
  return 1.0 / std::sqrt(std::max(least, 1e-9));
}

}  // namespace

std::string ScanOdometry::doubt(const ScanOdometryParams& params) const {
  if (static_cast<double>(blind) <= params.most_blind * static_cast<double>(steps)) return {};
  char text[160];
  std::snprintf(text, sizeof text,
                "there is no odometry, and %zu of %zu scans do not tell how the robot moved: too little lies around it",
                blind, steps);
  return text;
}

bool has_no_odometry(const recording::LaserLog& log) {
  return log.scans.size() > 1 && std::all_of(log.scans.begin(), log.scans.end(), [&](const auto& scan) {
           const Pose2 moved = inverse(log.scans.front().odom_from_base) * scan.odom_from_base;
           return norm(moved.position()) < kStill && std::abs(moved.theta.radians()) < kStill;
         });
}

ScanOdometry odometry_by_scans(recording::LaserLog& log, const mapping::GraphMapperParams& matching,
                               const ScanOdometryParams& params) {
  ScanOdometry found;
  const mapping::ScanChain chain{matching.chain, matching.chain_grid, matching.lines};
  std::vector<std::size_t> front;
  for (std::size_t i = 0; i < log.scans.size(); ++i)
    if (log.scans[i].rear == log.scans.front().rear) front.push_back(i);
  std::vector<mapping::MappingScan> scans;
  std::vector<Pose2> poses;
  Pose2 step;
  double seconds_before = 0.0;
  for (const std::size_t i : front) {
    scans.push_back(seen_by(log.scans[i], log.max_range, matching.points));
    const std::size_t n = scans.size() - 1;
    if (n == 0) {
      poses.push_back(log.scans[i].odom_from_base);
      scans.front().odom_from_base = poses.front();
      continue;
    }
    const double seconds = to_seconds(log.scans[i].time - log.scans[front[n - 1]].time);
    scans[n - 1].odom_from_base = poses[n - 1];
    scans[n].odom_from_base = poses[n - 1] * gone_on(step, seconds_before, seconds, params.longest);
    const mapping::ChainStep expected = chain.odometry_step(scans, n);
    const mapping::ChainStep matched = chain.step(scans, poses, n);
    ++found.steps;
    if (!matched.is_matched || widest(matched, expected) > params.blind) ++found.blind;
    step = matched.before_from_after;
    seconds_before = seconds;
    poses.push_back(poses[n - 1] * step);
  }
  std::size_t n = 0;
  for (std::size_t i = 0; i < log.scans.size(); ++i) {
    while (n + 1 < front.size() && front[n + 1] <= i) ++n;
    Pose2 pose = poses[n];
    if (front[n] != i && n + 1 < front.size()) {  // another laser's: between two of the first one's
      const double whole = to_seconds(log.scans[front[n + 1]].time - log.scans[front[n]].time);
      const double part = to_seconds(log.scans[i].time - log.scans[front[n]].time);
      pose = pose * gone_on(inverse(poses[n]) * poses[n + 1], whole, part, whole);
    }
    log.scans[i].odom_from_base = pose;
  }
  return found;
}

}  // namespace docent::apps::localize_command
