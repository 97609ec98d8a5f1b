#pragma once

#include "docent/sensor_models/range_sweep.h"
#include "docent/sensor_models/ray_caster.h"

namespace docent::localization {

/// How one sweep fits a pose at first sight: a few of its beams against the map. Cheap enough for every scan, so that
/// a robot that was carried off notices at once, not at its next update.
struct Glance {
  /// Share of the readings that are not too short which pass through walls of the map, or come back from nowhere though
  /// a wall is well within reach.
  double through = 0.0;
  double shorter = 0.0;  ///< share of all readings that end before the wall
  /// Share of the beams on straight walls (see on_straight_walls) that end well before the map's: walls that it lacks.
  /// People hide walls, they do not look like them; another place does both.
  double unmapped = 0.0;
  int readings = 0;  ///< where the map says what to expect

  static constexpr int kFewest = 10;  ///< readings: shares of fewer tell nothing
  [[nodiscard]] bool tells() const { return readings >= kFewest; }
};

/// O(beams), and at most some eighty rays. `max_range` [m].
[[nodiscard]] Glance glance(const sensor_models::RayCaster& caster, const sensor_models::RangeSweep& sweep,
                            const Pose2& map_from_robot, double max_range);

}  // namespace docent::localization
