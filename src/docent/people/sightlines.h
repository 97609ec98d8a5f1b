#pragma once

#include <cstddef>
#include <vector>

#include "docent/people/sightings.h"

namespace docent {

/// What a sweep says of a place where nobody was seen.
enum class Look {
  free,    ///< beams pass: nobody is there
  hidden,  ///< beams end before it: somebody may be there
  unclear  ///< no beam that way, or they end just there
};

/// Asks one sweep about places. Sorting once, then O(log beams + beams on the place) a look.
class Sightlines {
 public:
  Sightlines(const RangeSweep& sweep, const Pose2& odom_from_base);
  /// What the beams towards a disc say.
  [[nodiscard]] Look look(Point2 in_odom, double radius) const;

 private:
  Pose2 base_from_odom_;
  std::vector<SweepBeam> beams_;  ///< by bearing
};

}  // namespace docent
