#include "docent/mapping/graph_mapping/loop_closer.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace docent::mapping {
namespace {

/// What remains of it when nothing is known of the displacement along a way, as along a corridor.
Eigen::Matrix3d unknown_along(const Eigen::Matrix3d& information, const Pose2& way) {
  const Eigen::Vector3d u{way.x, way.y, 0.0};
  const Eigen::Vector3d pull = information * u;
  return information - pull * pull.transpose() / u.dot(pull) + 1e-6 * Eigen::Matrix3d::Identity();
}

}  // namespace

std::optional<LoopClosure> LoopCloser::close(const Submap& older, const Submap& newer, const Pose2& expected,
                                             const Eigen::Matrix3d& covariance, double restless) const {
  MatchWindow window;
  const double position_sigma = std::sqrt(std::max(covariance(0, 0), covariance(1, 1)));
  window.reach = std::clamp(params_.sigmas * position_sigma, params_.least_window, params_.widest_window);
  window.position_sigma = std::max(position_sigma, 0.1);
  window.heading_sigma = std::max(std::sqrt(covariance(2, 2)), 0.02);
  window.expectation_weight = params_.expectation_weight;
  window.turn = std::clamp(params_.sigmas * std::sqrt(covariance(2, 2)), params_.least_turn, std::numbers::pi);
  const auto best = best_match(older.grid(), newer.query(), expected, window, params_.least_score);
  if (!best) return std::nullopt;
  const ForbiddenPlace here{best->reference_from_sweep, params_.elsewhere, params_.elsewhere_turn};
  const auto other =
      best_match(older.grid(), newer.query(), expected, window, params_.clearly_best * best->score, &here);
  const double best_is_off = distance(best->reference_from_sweep.position(), expected.position());
  if (other && best_is_off > params_.narrow_window) return std::nullopt;
  auto fine = line_match(SurfaceIndex{older.points()}, newer.points(), best->reference_from_sweep, lines_);
  if (!fine || fine->overlap < params_.least_overlap) return std::nullopt;
  const double conflict = share_in_conflict(older, newer, fine->reference_from_sweep);
  if (conflict > params_.most_conflict + restless) return std::nullopt;
  if (other)
    fine->information =
        unknown_along(fine->information, inverse(best->reference_from_sweep) * other->reference_from_sweep);
  LoopClosure closure;
  closure.constraint = {older.middle(), newer.middle(), fine->reference_from_sweep, fine->information, true};
  closure.surprise = distance(fine->reference_from_sweep.position(), expected.position());
  return closure;
}

}  // namespace docent::mapping
