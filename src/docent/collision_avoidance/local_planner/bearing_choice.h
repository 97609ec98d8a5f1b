#pragma once

#include <numbers>
#include <optional>
#include <span>

#include "docent/collision_avoidance/body/obstacle.h"
#include "docent/geometry/pose2.h"

namespace docent::collision_avoidance {

struct BearingChoiceParams {
  double least_way = 0.3;                 ///< [m] a way that is nearer to its end than that counts as so long
  double most_way = 1.5;                  ///< [m] of free way are enough, however far the point lies
  double step = std::numbers::pi / 36.0;  ///< [rad] between two bearings that are tried
  int steps = 16;                         ///< to either side, to 80 degrees: more is no way to the goal
  double way_weight = 1.4;                ///< [rad] a way that is not free at all counts as so much of a detour
  double change_weight = 0.25;            ///< against another bearing than was steered before
  double begins = 0.04;                   ///< [m] of a way; one that is shorter is none
  double none = 2.0;  ///< [rad] of detour that a way which does not begin counts as, when there are others
  double ahead = 0.25 * std::numbers::pi;  ///< [rad] what stands within that of the way may go, and is waited for
  double behind = 2.4;                     ///< [rad] what lies so far round may be reached by turning either way
  double beside = 1.5;                     ///< [rad] the side of a turn is forgotten when its goal lies within that
};

/// The bearing to steer by so that the way to a point leads round what stands before it. Keeps to the bearing and the
/// side of before where nothing speaks for another one: noise must not change the mind half way round.
class BearingChoice {
 public:
  BearingChoice(double body_radius, const BearingChoiceParams& params = {}) : radius_{body_radius}, params_{params} {}

  /// @returns bearing [rad], base frame. O(bearings * obstacles).
  [[nodiscard]] double choose(Point2 wanted_in_base, const Pose2& odom_from_base, std::span<const Obstacle> obstacles);
  /// The robot stands: it need not keep to the bearing of before.
  void forget() { chosen_in_odom_.reset(); }

 private:
  /// True when the way does not even begin because of a hazard's margin, or of what is sensed beside the robot: it must
  /// slide off. What stands ahead is another matter: that may go, and it waits.
  [[nodiscard]] bool must_slide_off(double bearing, std::span<const Obstacle> obstacles) const;
  [[nodiscard]] double best_near(double wanted, double need, const Pose2& odom_from_base,
                                 std::span<const Obstacle> obstacles) const;

  double radius_;
  BearingChoiceParams params_;
  std::optional<Angle> chosen_in_odom_;
  double turning_side_ = 0.0;  ///< +1 left, -1 right, while something behind is turned to; else 0
};

}  // namespace docent::collision_avoidance
