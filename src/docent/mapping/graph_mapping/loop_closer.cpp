#include "docent/mapping/graph_mapping/loop_closer.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace docent::mapping {
namespace {

double share_on_free_floor(const Segment& seer, std::span<const Point2> points, const Pose2& seer_from_points) {
  if (points.empty()) return 0.0;
  const auto count =
      std::count_if(points.begin(), points.end(), [&](Point2 p) { return seer.is_free(seer_from_points * p); });
  return static_cast<double>(count) / static_cast<double>(points.size());
}

}  // namespace

std::optional<LoopClosure> LoopCloser::close(const Segment& older, const Segment& newer, const Pose2& expected,
                                             const Eigen::Matrix3d& covariance) const {
  MatchWindow window;
  const double position_sigma = std::sqrt(std::max(covariance(0, 0), covariance(1, 1)));
  window.reach = std::clamp(params_.sigmas * position_sigma, params_.least_window, params_.widest_window);
  window.turn = std::clamp(params_.sigmas * std::sqrt(covariance(2, 2)), params_.least_turn, std::numbers::pi);
  const auto best = best_match(older.grid(), newer.query(), expected, window, params_.least_score);
  if (!best) return std::nullopt;
  const ForbiddenPlace here{best->reference_from_sweep, params_.elsewhere, params_.elsewhere_turn};
  if (best_match(older.grid(), newer.query(), expected, window, params_.clearly_best * best->score, &here)) {
    return std::nullopt;
  }
  const auto fine = line_match(SurfaceIndex{older.points()}, newer.points(), best->reference_from_sweep, lines_);
  if (!fine || fine->overlap < params_.least_overlap) return std::nullopt;
  const double conflict = std::max(share_on_free_floor(older, newer.query(), fine->reference_from_sweep),
                                   share_on_free_floor(newer, older.query(), inverse(fine->reference_from_sweep)));
  if (conflict > params_.most_conflict) return std::nullopt;
  LoopClosure closure;
  closure.constraint = {older.middle(), newer.middle(), fine->reference_from_sweep, fine->information, true};
  closure.score = best->score;
  closure.overlap = fine->overlap;
  closure.conflict = conflict;
  closure.window = window.reach;
  return closure;
}

}  // namespace docent::mapping
