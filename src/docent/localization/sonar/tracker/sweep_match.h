#pragma once

#include <vector>

#include "docent/base/result.h"
#include "docent/localization/sonar/tracker/drift_filter.h"
#include "docent/localization/sonar/tracker/echo_map.h"

namespace docent::localization {

/// How echoes are matched with the map of echoes.
struct SweepMatchParams {
  double half_cone = 10.0;   ///< [deg], > 0 and < 45: within it a surface is heard
  double max_range = 4.0;    ///< [m], > 0: longer echoes are not used
  double deviation = 0.04;   ///< [m], > 0: of an echo from the map at hand, at 0 m
  double per_metre = 0.015;  ///< >= 0: more with the distance
  double robustness = 2.5;   ///< > 0: deviations beyond which an echo says nothing any more
  double oblique = 25.0;     ///< [deg], > 0: a surface slanted by more is heard by chance only
  double dependence = 4.0;   ///< >= 1: so many echoes count as one; neighbours err together, so does a shifted wall
  double least_deviation = 0.015;  ///< [m], > 0: no match is better than the map
  double least_turn = 2.0;         ///< [deg], > 0; which edge a cone still hears is guessed, and it turns the answer
  double inliers = 0.4;            ///< 0..1: share of the comparable echoes that the pose must explain
  int echoes = 15;                 ///< >= 3: comparable ones
  double gate = 4.0;               ///< > 0: deviations of the prior that a correction may have
  double distinct = 2.0;           ///< >= 0: log of how much better the best pose must be than one elsewhere
  template <class V>
  void visit(V& v) {
    v("half_cone", half_cone);
    v("max_range", max_range);
    v("deviation", deviation);
    v("per_metre", per_metre);
    v("robustness", robustness);
    v("oblique", oblique);
    v("dependence", dependence);
    v("least_deviation", least_deviation);
    v("least_turn", least_turn);
    v("inliers", inliers);
    v("echoes", echoes);
    v("gate", gate);
    v("distinct", distinct);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// One reading, placed by odometry relative to the pose that is sought.
struct PlacedEcho {
  Pose2 robot_from_sonar;  ///< where the sonar was, seen from where the robot is now
  double range = 0.0;      ///< [m]
};

enum class MatchOutcome { matched, too_few_echoes, unlike_the_map, ambiguous, too_far_off };

struct SweepMatch {
  MatchOutcome outcome = MatchOutcome::too_few_echoes;
  Pose2 map_from_robot;     ///< most probable, prior included
  PoseMatrix covariance{};  ///< likewise
  double inliers = 0.0;     ///< share of the comparable echoes within `robustness` deviations
  int comparable = 0;       ///< echoes for which the map predicts a surface
};

/// Matches a sweep that was gathered on the way to the map [Buhmann1995]: the pose that maximises prior times a robust
/// likelihood of the echoes, found on a lattice over the prior and refined by Gauss-Newton. Readings that are shorter
/// or longer than the map says say nothing, however wrong they are. Deterministic; O(125 * echoes) expected ranges.
[[nodiscard]] SweepMatch match_sweep(const SweepMatchParams& params, const EchoMap& map,
                                     const std::vector<PlacedEcho>& echoes, const Pose2& prior,
                                     const PoseMatrix& prior_covariance);

}  // namespace docent::localization
