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

/// A corridor of 24 x 2.4 m, the same from both ends but for an alcove in the side wall at x from 18 to 19.
inline OccupancyGrid corridor_with_alcove() {
  OccupancyGrid map;
  map.frame = {260, 64, 0.1, {-1.0, -1.0}};
  map.cells.assign(map.frame.size(), OccupancyGrid::kOccupied);
  for (int row = 0; row < map.frame.rows; ++row) {
    for (int column = 0; column < map.frame.columns; ++column) {
      const Point2 at = map.frame.centre({column, row});
      const bool is_hall = at.x > 0.0 && at.x < 24.0 && at.y > 0.0 && at.y < 2.4;
      const bool is_alcove = at.x > 18.0 && at.x < 19.0 && at.y > 2.0 && at.y < 4.0;
      if (is_hall || is_alcove) map.cells[map.frame.index({column, row})] = OccupancyGrid::kFree;
    }
  }
  return map;
}

}  // namespace docent::planning::testing
