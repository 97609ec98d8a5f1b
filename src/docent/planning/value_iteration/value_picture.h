#pragma once

#include <cstdint>
#include <vector>

#include "docent/grid/occupancy_grid.h"
#include "docent/planning/value_iteration/value_iteration.h"

namespace docent::planning {

/// A value function to look at.
struct ValuePicture {
  GridFrame frame;
  std::vector<std::int8_t> shares;  ///< [rows * columns] 0 at the goal, 100 at the greatest cost; -1: no way from there
};

/// Coarser by `side`: of the cells that become one, the nearest to the goal counts. O(cells).
[[nodiscard]] ValuePicture value_picture(const ValueIteration& values, int side);

}  // namespace docent::planning
