#pragma once

#include <cstddef>
#include <vector>

#include "docent/geometry/point_transform.h"
#include "docent/sensor_models/range_sweep.h"

namespace docent::people {

/// What a sweep says of a place where nobody was seen.
enum class Look {
  free,    ///< beams pass: nobody is there
  hidden,  ///< beams end before it: somebody may be there
  unclear  ///< no beam that way, or they end just there
};

/// Asks one sweep about places. Sorting once, then O(log beams + beams on the place) a look.
class Sightlines {
 public:
  Sightlines(const sensor_models::RangeSweep& sweep, const Pose2& odom_from_base);
  /// What the beams towards a disc say.
  [[nodiscard]] Look look(Point2 in_odom, double radius) const;
  /// Of the beams towards a disc that nothing stops before it, the share that ends on its near side: little where
  /// glass or dust returns a beam now and then. 1 where there is none.
  [[nodiscard]] double share_on(Point2 in_odom, double radius) const;

 private:
  /// Calls f(beam, away) for the beams towards the middle of a disc; false when the robot stands in it.
  template <class F>
  bool for_each_towards(Point2 in_odom, double radius, F&& f) const;
  PointTransform base_from_odom_;
  std::vector<sensor_models::SweepBeam> beams_;  ///< by bearing
};

}  // namespace docent::people
