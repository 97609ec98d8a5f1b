#pragma once

#include "docent/grid/occupancy_grid.h"

namespace docent::mapping {

/// Takes free floor out of a map of which there is less than `least` m2 in one piece: a few stray beams have seen it,
/// behind walls mostly. It becomes unknown. O(cells).
void forget_stray_floor(OccupancyGrid& map, double least);

}  // namespace docent::mapping
