#pragma once

#include <optional>
#include <span>

#include "docent/mapping/scan_matching/match_grid.h"

namespace docent::mapping {

/// Where a match is looked for, about the expected pose.
struct MatchWindow {
  double reach = 0.5;             ///< [m], >= 0, along each axis
  double turn = 0.35;             ///< [rad], >= 0, each way; pi: all headings
  double position_sigma = 1e9;    ///< [m], > 0: of the expectation
  double heading_sigma = 1e9;     ///< [rad], > 0
  double expectation_weight = 0;  ///< >= 0: what half a squared sigma costs, as a share of the score
};

struct CorrelativeMatch {
  Pose2 reference_from_sweep;
  double score = 0.0;  ///< 0..1: mean value of the points, less what the distance from the expectation costs
};

/// Poses near a known one that a search passes over, to find the next best place.
struct ForbiddenPlace {
  Pose2 pose;
  double reach = 0.0;  ///< [m]
  double turn = 0.0;   ///< [rad]
};

/// The best pose of `points` (the sweep's frame) over the grid within the window, to one cell and to a heading at which
/// the farthest point moves by one cell: branch and bound over all of them (W. Hess et al., ICRA 2016, algorithm 3), so
/// none is missed. None where no pose reaches `least` (0..1). O(poses in the window) at worst, far less where one place
/// stands out. @pre points not empty
[[nodiscard]] std::optional<CorrelativeMatch> best_match(const MatchGrid& grid, std::span<const Point2> points,
                                                         const Pose2& expected, const MatchWindow& window, double least,
                                                         const ForbiddenPlace* not_near = nullptr);

}  // namespace docent::mapping
