#pragma once

#include "docent/base/result.h"
#include "docent/geometry/pose2.h"

namespace docent::collision_avoidance {

/// What of people a laser at the height of legs does not see.
struct UnseenBodyParams {
  double ahead = 0.12;  ///< [m] that a body reaches beyond its legs, ahead: belly, hands, toes
  double aside = 0.22;  ///< [m] likewise to the sides, where people lean, swing their arms and carry bags
  double waist = 0.7;   ///< [m] above the floor: a laser so high meets the body itself
  template <class V>
  void visit(V& v) {
    v("ahead", ahead);
    v("aside", aside);
    v("waist", waist);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// How much farther people reach than what the lasers see of them.
class UnseenBodies {
 public:
  /// @param laser_height  [m] above the floor, of the lowest laser
  UnseenBodies(const UnseenBodyParams& params, double laser_height);

  struct Reach {
    double likely = 0.0;  ///< [m] beyond what was seen: kept free
    double most = 0.0;    ///< [m] likewise, at least `likely`: so near, the robot is no faster than harmless
  };
  /// Towards the robot.
  /// @param at  [m] what was seen of them, base frame @param velocity  [m/s] likewise, zero for who stands: how they
  /// face is not known then
  [[nodiscard]] Reach reach(Point2 at, Point2 velocity) const;

 private:
  double ahead_;
  double aside_;
};

}  // namespace docent::collision_avoidance
