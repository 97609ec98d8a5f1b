#pragma once

#include <vector>

#include "docent/grid/occupancy_grid.h"
#include "docent/sensor_models/range_sweep.h"

namespace docent::planning {

/// What the map so far says of each beam, so that those who are about can be followed: what ends on floor that was seen
/// to be free is of nobody's building. O(beams)
/// @returns [beams]
[[nodiscard]] std::vector<sensor_models::BeamOrigin> beam_origins(const OccupancyGrid& map,
                                                                  const sensor_models::RangeSweep& sweep,
                                                                  const Pose2& map_from_base);

}  // namespace docent::planning
