#pragma once
#include <docent/grid/occupancy_grid.h>

#include <cstdio>
#include <string>
#include <vector>

#include "simulated_robot.h"

namespace example {

/// A map, a letter for 60 x 60 cm: # something stands there, o a way.
inline void print(const docent::OccupancyGrid& map, const std::vector<docent::Point2>& way) {
  const docent::OccupancyGrid coarse = docent::coarsened(map, 12);
  std::vector<std::string> rows(static_cast<std::size_t>(coarse.frame.rows));
  for (int row = 0; row < coarse.frame.rows; ++row)
    for (int column = 0; column < coarse.frame.columns; ++column)
      rows[static_cast<std::size_t>(row)] += coarse.is_occupied({column, row}) ? '#' : ' ';
  for (const docent::Point2 point : way) {
    const docent::CellIndex cell = coarse.frame.cell_at(point);
    rows[static_cast<std::size_t>(cell.row)][static_cast<std::size_t>(cell.column)] = 'o';
  }
  for (auto row = rows.rbegin(); row != rows.rend(); ++row) std::printf("  %s\n", row->c_str());
}

}  // namespace example
