#pragma once

#include <optional>
#include <vector>

#include "docent/base/time.h"
#include "docent/collision_avoidance/body/base_motion.h"
#include "docent/collision_avoidance/obstacle_field/felt_things.h"
#include "docent/geometry/pose2.h"

namespace docent::collision_avoidance {

struct FeltPlacesParams {
  bool remembers = true;     ///< false: crippled, for evaluation: what was touched is forgotten
  double sure = 0.9;         ///< 0..1 of the belief at its best place: then that is where the robot is
  double point_step = 0.06;  ///< [m] between the points of a disc's outline
};

/// Keeps what only touch finds where it stands in the building: in the map's frame, as soon as the robot knows its
/// place, for odometry wanders off in the minutes until it comes by again. A wrong place makes it careful elsewhere,
/// and no less careful about what it senses now. Deterministic.
class FeltPlaces {
 public:
  explicit FeltPlaces(const FeltPlacesParams& params, const FeltThingsParams& things = {})
      : params_{params}, things_{things} {}

  /// @param mass  of the belief there
  void believe(const Pose2& map_from_odom, double mass);
  /// @param at, outward  odometry's frame, see FeltThings
  void feel(Point2 at, Point2 outward, bool may_be_somebody, Time now);
  /// The body stands here, odometry's frame.
  void stand(Point2 centre, double radius, Time now);
  /// Points [m], base frame, on the outlines of what stands within `reach` [m] of the robot's centre.
  [[nodiscard]] std::vector<Point2> outlines(const Pose2& odom_from_base, double reach) const;
  /// [m] from the body to the nearest; +infinity: there is none.
  [[nodiscard]] double gap(const Pose2& odom_from_base, const BaseLimits& limits) const;

 private:
  FeltPlacesParams params_;
  FeltThings things_;
  std::optional<Pose2> map_from_odom_;  ///< nullopt: not known yet, and `things_` are in odometry's frame
};

}  // namespace docent::collision_avoidance
