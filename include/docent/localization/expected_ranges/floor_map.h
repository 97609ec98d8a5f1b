#pragma once

#include <span>

#include "docent/geometry/polygon.h"
#include "docent/grid/occupancy_grid.h"

namespace docent::localization {

/// A map as localization takes it: what the lasers meet, and where a robot can stand. Lasers look across staircases
/// and glass cases; no robot stands in them.
struct FloorMap {
  /// `closed`: [m] in the map. O(cells * corners).
  FloorMap(const OccupancyGrid& map, std::span<const Polygon> closed = {});

  OccupancyGrid walls;     ///< what the lasers meet
  OccupancyGrid standing;  ///< the same, what is closed unknown
};

}  // namespace docent::localization
