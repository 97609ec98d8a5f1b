#pragma once

#include <span>
#include <vector>

#include "docent/geometry/pose2.h"

namespace docent {

/// A disc about the robot's centre must not come nearer than `reach` to `at`.
struct ReachPoint {
  Point2 at;           ///< [m], robot frame
  double reach = 0.0;  ///< [m]
};

/// Length of the way [m] along the circle of the given curvature, from the origin with heading +x, until the robot's
/// centre is `reach` away from the point. Closed form. Driving backwards: mirror the point in x and the curvature.
///
/// A point that is within reach already gives 0 when the first step brings the robot nearer, else infinity (driving
/// away from what is too near is how a robot gets free). Infinity also when the circle never meets the point.
/// @param curvature  [1/m], positive to the left
[[nodiscard]] double arc_distance(double curvature, const ReachPoint& point);

/// The free way along every curvature of a fan, against a set of points: `build` once a cycle, then look up.
class ArcTable {
 public:
  static constexpr int kCurvatures = 97;        ///< odd: the middle one is straight
  static constexpr double kMaxCurvature = 6.0;  ///< [1/m]; a tighter curve is nearly a turn on the spot
  static constexpr double kHorizon = 4.0;       ///< [m]

  /// O(curvatures * points). `backwards`: the fan that is driven in reverse.
  void build(std::span<const ReachPoint> points, bool backwards);
  /// Free way [m], at most kHorizon, along the circle of velocity (linear, angular): the lesser of the two neighbouring
  /// curvatures. On the spot (linear 0): kHorizon.
  [[nodiscard]] double free_way(double linear, double angular) const;
  [[nodiscard]] static double curvature(int index);

 private:
  std::vector<double> free_ = std::vector<double>(kCurvatures, kHorizon);
};

}  // namespace docent
