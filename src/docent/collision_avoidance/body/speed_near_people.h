#pragma once

#include <vector>

#include "docent/base/result.h"
#include "docent/collision_avoidance/body/base_motion.h"
#include "docent/geometry/pose2.h"

namespace docent::collision_avoidance {

/// What people may do that nobody foresees, and what a robot may do about it.
struct PeopleCautionParams {
  double surprise = 0.4;  ///< [m/s] by which anybody may come nearer than their motion tells
  double spurt = 2.5;     ///< [m/s2] with which they begin to
  double reaction = 0.3;  ///< [s] from a surprise to full braking: a sweep, a choice, the base
  double harmless = 0.1;  ///< [m/s] towards somebody: nobody minds
  double step = 0.05;     ///< [s] between the moments of a way that are looked at; no key of robot.yaml
  template <class V>
  void visit(V& v) {
    v("surprise", surprise);
    v("reaction", reaction);
    v("harmless", harmless);
    v("spurt", spurt);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// A piece of somebody's outline as the robot sees it, base frame turned so that +x is the robot's way.
struct PersonPoint {
  Point2 at;           ///< [m]
  Point2 velocity{};   ///< [m/s], zero for who stands
  double reach = 0.0;  ///< [m] between the robot's centre and the point counts as a touch
};

/// The way of a robot that drives with `speed` [m/s] along an arc of `curvature` [1/m] and brakes fully one reaction
/// after somebody begins to come nearer than foreseen. Found once for all people.
class BrakingWay {
 public:
  BrakingWay(double speed, double curvature, const BaseLimits& limits, const PeopleCautionParams& params);
  /// True when the robot meets them nowhere faster than harmless before it stands. A person beside the way thus slows
  /// the robot less than one in it, and one who walks away less than one who comes. O(speed).
  [[nodiscard]] bool is_forgivable(const PersonPoint& person) const;

 private:
  struct Step {
    double time;      ///< [s]
    double speed;     ///< [m/s]
    Point2 at;        ///< [m]
    Point2 ahead;     ///< unit vector
    double surprise;  ///< [m] by which somebody may have come nearer
  };
  double speed_;
  double end_;  ///< [s] when it stands
  PeopleCautionParams params_;
  std::vector<Step> steps_;
};

}  // namespace docent::collision_avoidance
