#pragma once

#include "docent/grid/occupancy_grid.h"

namespace docent {

/// The map turned about (0, 0) by `angle` [rad], as a grid along the axes again. A cell takes what lies at its centre;
/// no wall is lost between two centres: an occupied cell also fills the one that its own centre comes to. O(cells).
[[nodiscard]] OccupancyGrid turned(const OccupancyGrid& map, double angle);

}  // namespace docent
