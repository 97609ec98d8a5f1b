#pragma once

#include <algorithm>
#include <optional>

#include "docent/grid/occupancy_grid.h"

namespace docent::mapping {

/// Cells from `low` to `high`, both among them.
struct CellRectangle {
  CellIndex low, high;
};

/// Makes the rectangle so large that it holds the cell.
inline void widen(std::optional<CellRectangle>& rectangle, CellIndex cell) {
  if (!rectangle) rectangle = CellRectangle{cell, cell};
  rectangle->low = {std::min(rectangle->low.column, cell.column), std::min(rectangle->low.row, cell.row)};
  rectangle->high = {std::max(rectangle->high.column, cell.column), std::max(rectangle->high.row, cell.row)};
}

}  // namespace docent::mapping
