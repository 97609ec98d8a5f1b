#pragma once

#include "docent/sensor_models/range_sweep.h"
#include "docent/sensor_models/ray_caster.h"

namespace docent {

/// How one sweep fits a pose at first sight: a few of its beams against the map. Cheap enough for every scan, so that
/// a robot that was carried off notices at once, not at its next update.
struct Glance {
  /// Share of the readings that are not too short which pass through walls of the map, or come back from nowhere though
  /// a wall is well within reach.
  double through = 0.0;
  double shorter = 0.0;  ///< share of all readings that end before the wall
  int readings = 0;      ///< where the map says what to expect
};

/// O(1): at most some forty rays. `max_range` [m].
[[nodiscard]] Glance glance(const RayCaster& caster, const RangeSweep& sweep, const Pose2& map_from_robot,
                            double max_range);

}  // namespace docent
