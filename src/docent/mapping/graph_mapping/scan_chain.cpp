#include "docent/mapping/graph_mapping/scan_chain.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace docent::mapping {
namespace {

/// [m] Scans from farther away show another place: the odometry between has jumped. A grid about both would be endless.
constexpr double kFarthestScan = 50.0;

std::vector<Point2> places_of(std::span<const SurfacePoint> points) {
  std::vector<Point2> places;
  places.reserve(points.size());
  for (const SurfacePoint& point : points) places.push_back(point.at);
  return places;
}

Eigen::Matrix3d diagonal_information(double way_sigma, double turn_sigma) {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  information(0, 0) = information(1, 1) = 1.0 / (way_sigma * way_sigma);
  information(2, 2) = 1.0 / (turn_sigma * turn_sigma);
  return information;
}

}  // namespace

Result<void> ScanChainParams::validate() const {
  if (!(scans > 0)) return fail("scans must be > 0");
  if (!(way_sigma > 0.0)) return fail("way_sigma must be > 0 m");
  if (!(way_per_metre >= 0.0)) return fail("way_per_metre must be >= 0");
  if (!(way_per_radian >= 0.0)) return fail("way_per_radian must be >= 0");
  if (!(turn_sigma > 0.0)) return fail("turn_sigma must be > 0 rad");
  if (!(turn_per_metre >= 0.0)) return fail("turn_per_metre must be >= 0");
  if (!(turn_per_radian >= 0.0)) return fail("turn_per_radian must be >= 0");
  if (!(sigmas > 0.0)) return fail("sigmas must be > 0");
  if (!(most_reach > 0.0)) return fail("most_reach must be > 0 m");
  if (!(expectation_weight >= 0.0)) return fail("expectation_weight must be >= 0");
  if (!(least_score >= 0.0 && least_score <= 1.0)) return fail("least_score must be 0..1");
  if (!(fewest_points > 0)) return fail("fewest_points must be > 0");
  if (!(query_cell > 0.0)) return fail("query_cell must be > 0 m");
  return {};
}

ChainStep ScanChain::odometry_step(std::span<const MappingScan> scans, std::size_t i) const {
  const Pose2 odometry = inverse(scans[i - 1].odom_from_base) * scans[i].odom_from_base;
  const auto [way_sigma, turn_sigma] = sigmas_of(odometry);
  return {odometry, diagonal_information(way_sigma, turn_sigma), false};
}

ScanChain::Sigmas ScanChain::sigmas_of(const Pose2& odometry) const {
  const double way = norm(odometry.position());
  const double turn = std::abs(odometry.theta.radians());
  return {params_.way_sigma + params_.way_per_metre * way + params_.way_per_radian * turn,
          params_.turn_sigma + params_.turn_per_metre * way + params_.turn_per_radian * turn};
}

ChainStep ScanChain::step(std::span<const MappingScan> scans, std::span<const Pose2> map_from_base,
                          std::size_t i) const {
  ChainStep result = odometry_step(scans, i);
  const Pose2 odometry = result.before_from_after;
  const auto [way_sigma, turn_sigma] = sigmas_of(odometry);

  const Pose2& before = map_from_base[i - 1];
  const Pose2 before_from_map = inverse(before);
  std::vector<SurfacePoint> local;
  const std::size_t first = i - std::min(i, static_cast<std::size_t>(params_.scans));
  for (std::size_t k = first; k < i; ++k) {
    const Pose2 before_from_scan = before_from_map * map_from_base[k];
    if (norm(before_from_scan.position()) > kFarthestScan) continue;
    for (const SurfacePoint& point : scans[k].points) local.push_back(transformed(before_from_scan, point));
  }
  if (local.empty() || scans[i].points.size() < static_cast<std::size_t>(params_.fewest_points)) return result;
  const MatchGrid grid{places_of(local), grid_};
  MatchWindow window;
  window.reach = std::min(params_.sigmas * way_sigma, params_.most_reach);
  window.turn = std::min(params_.sigmas * turn_sigma, std::numbers::pi);
  window.position_sigma = way_sigma;
  window.heading_sigma = turn_sigma;
  window.expectation_weight = params_.expectation_weight;
  const std::vector<Point2> query = thinned_points(places_of(scans[i].points), params_.query_cell);
  const auto found = best_match(grid, query, odometry, window, params_.least_score);
  if (!found) return result;
  const auto fine = line_match(SurfaceIndex{local}, scans[i].points, found->reference_from_sweep, lines_);
  if (!fine) return result;
  result.before_from_after = fine->reference_from_sweep;
  result.information += fine->information;
  result.is_matched = true;
  const Pose2 error = inverse(odometry) * fine->reference_from_sweep;
  const double in_way = norm(error.position()) / way_sigma;
  const double in_turn = error.theta.radians() / turn_sigma;
  result.surprise = (in_way * in_way + in_turn * in_turn) / 3.0;
  return result;
}

std::vector<Pose2> chain_of(std::span<const MappingScan> scans, const ScanChain& chain) {
  std::vector<Pose2> steps;
  std::vector<Pose2> map_from_base;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    if (i == 0) {
      map_from_base.push_back(scans[i].odom_from_base);
      continue;
    }
    steps.push_back(chain.step(scans, map_from_base, i).before_from_after);
    map_from_base.push_back(map_from_base.back() * steps.back());
  }
  return steps;
}

}  // namespace docent::mapping
