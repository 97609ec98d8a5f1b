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

Result<void> LoopCloserParams::validate() const {
  if (!(least_score >= 0.0 && least_score <= 1.0)) return fail("least_score must be 0..1");
  if (!(least_overlap >= 0.0 && least_overlap <= 1.0)) return fail("least_overlap must be 0..1");
  if (!(most_conflict >= 0.0 && most_conflict <= 1.0)) return fail("most_conflict must be 0..1");
  if (!(clearly_best >= 0.0 && clearly_best <= 1.0)) return fail("clearly_best must be 0..1");
  if (!(elsewhere >= 0.0)) return fail("elsewhere must be >= 0 m");
  if (!(elsewhere_turn >= 0.0)) return fail("elsewhere_turn must be >= 0 rad");
  if (!(widest_window > 0.0)) return fail("widest_window must be > 0 m");
  if (!(narrow_window >= 0.0)) return fail("narrow_window must be >= 0 m");
  if (!(expectation_weight >= 0.0)) return fail("expectation_weight must be >= 0");
  if (!(sigmas > 0.0)) return fail("sigmas must be > 0");
  if (!(least_window >= 0.0 && least_window <= widest_window))
    return fail("least_window must be >= 0 m and <= widest_window");
  if (!(least_turn >= 0.0 && least_turn <= std::numbers::pi)) return fail("least_turn must be 0..pi rad");
  return {};
}

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
