#pragma once

#include "docent/base/result.h"
#include "docent/grid/occupancy_grid.h"
#include "docent/simulator/world/world.h"

namespace docent::apps::score_map_command {

/// A learned map beside the true world that it is of.
struct MapScore {
  Pose2 world_from_map;         ///< the rigid motion that lays it best over the world
  std::size_t occupied = 0;     ///< cells
  std::size_t free = 0;         ///< cells
  double wall_error = 0.0;      ///< [m], mean distance of occupied cells from true structure, ghosts left out
  double wall_error_p95 = 0.0;  ///< [m], likewise
  std::size_t ghosts = 0;       ///< occupied cells over 0.3 m from true structure
  double floor = 0.0;           ///< [m2] that the robot's lasers can see from where it can drive, see reachable_floor
  double covered = 0.0;         ///< 0..1: of that floor, what the map calls free, or beside a wall occupied
  double found = 0.0;           ///< 0..1: of the true surfaces that border on floor the map calls free, those it has
};

/// Lays the map over the world by a search of all headings and places, then finely, and measures it. Error: an empty
/// map, or one that fits nowhere. Takes seconds.
[[nodiscard]] Result<MapScore> score_map(const OccupancyGrid& map, const simulator::World& world);

}  // namespace docent::apps::score_map_command
