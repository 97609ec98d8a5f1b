#pragma once

#include <algorithm>
#include <cmath>

#include "docent/grid/occupancy_grid.h"

namespace docent::planning::testing {

/// A hall of 12 x 12 m with a wall at x = 6 m that two doors lead through: one in the middle (y = 6 m), the other at
/// the northern end (y = 10.5 m). Planning cells of 15 cm: 80 x 80.
inline OccupancyGrid hall_with_two_doors() {
  constexpr double kSide = 12.0;  // [m]
  constexpr int kCells = 240;     // along it
  OccupancyGrid map;
  map.frame = {kCells, kCells, 0.05, {0.0, 0.0}};
  map.cells.assign(map.frame.size(), OccupancyGrid::kFree);
  for (int row = 0; row < kCells; ++row) {
    for (int column = 0; column < kCells; ++column) {
      const Point2 at = map.frame.centre({column, row});
      const bool is_door = std::abs(at.y - 6.0) < 0.9 || std::abs(at.y - 10.5) < 0.9;
      const bool is_wall = (std::abs(at.x - 6.0) < 0.15 && !is_door) || std::min(at.x, at.y) < 0.15 ||
                           std::max(at.x, at.y) > kSide - 0.15;
      if (is_wall) map.cells[map.frame.index({column, row})] = OccupancyGrid::kOccupied;
    }
  }
  return map;
}

}  // namespace docent::planning::testing
