#pragma once

#include <vector>

#include "docent/grid/occupancy_grid.h"
#include "docent/planning/coastal/coastal_planner.h"

namespace docent::planning::testing {

/// An empty hall of `width` x `height` metres with walls of 20 cm, its lower left inner corner at (0, 0).
inline OccupancyGrid hall(double width, double height) {
  constexpr double kCell = 0.05;
  constexpr int kWall = 4;  // cells
  OccupancyGrid map;
  map.frame = {static_cast<int>(width / kCell) + 2 * kWall,
               static_cast<int>(height / kCell) + 2 * kWall,
               kCell,
               {-kWall * kCell, -kWall * kCell}};
  map.cells.assign(map.frame.size(), OccupancyGrid::kFree);
  for (int row = 0; row < map.frame.rows; ++row) {
    for (int column = 0; column < map.frame.columns; ++column) {
      const bool inside =
          row >= kWall && column >= kWall && row < map.frame.rows - kWall && column < map.frame.columns - kWall;
      if (!inside) map.cells[map.frame.index({column, row})] = OccupancyGrid::kOccupied;
    }
  }
  return map;
}

/// Cells of 30 cm that cost their size, but for those nearer than 40 cm to what the map holds.
inline CoastalFloor floor_of(const OccupancyGrid& map) {
  constexpr int kFactor = 6;
  CoastalFloor floor;
  floor.frame = {map.frame.columns / kFactor, map.frame.rows / kFactor, map.frame.resolution * kFactor,
                 map.frame.origin};
  std::vector<bool> solid(map.frame.size());
  for (std::size_t i = 0; i < solid.size(); ++i) solid[i] = map.cells[i] != OccupancyGrid::kFree;
  const auto clearances = distance_transform(map.frame, solid);
  for (int row = 0; row < floor.frame.rows; ++row) {
    for (int column = 0; column < floor.frame.columns; ++column) {
      const float clearance = clearances[map.frame.index(map.frame.cell_at(floor.frame.centre({column, row})))];
      floor.costs.push_back(clearance > 0.4F ? static_cast<float>(floor.frame.resolution)
                                             : std::numeric_limits<float>::infinity());
    }
  }
  return floor;
}

}  // namespace docent::planning::testing
