#pragma once

#include <cstddef>

#include "docent/geometry/pose2.h"
#include "docent/sensor_models/range_sweep.h"

namespace docent::localization {

/// Readings of two sweeps of one laser, and those of them that end on what is shaped like a person where the other
/// sweep has looked through: who stands there now has come since, or has gone. Both sweeps should lie about a second
/// apart: odometry must hold, and who walks must have left the place.
struct MovedThings {
  std::size_t readings = 0;  ///< that end where the other sweep has looked
  std::size_t moved = 0;     ///< of them, on persons in what was free floor for it
  MovedThings& operator+=(const MovedThings& other);
  /// 0 without readings.
  [[nodiscard]] double share() const;
};
/// Sweeps in the laser's own frame; `before_from_now` by odometry. O(beams)
[[nodiscard]] MovedThings moved_things(const sensor_models::RangeSweep& before, const sensor_models::RangeSweep& now,
                                       const Pose2& before_from_now);

}  // namespace docent::localization
