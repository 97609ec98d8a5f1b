#pragma once

#include <vector>

#include "docent/grid/occupancy_grid.h"

namespace docent::simulator {

/// The map that a traced museum hands to its robot: as it was given wherever the building that was traced from it does
/// not reach, so that rooms behind gaps too narrow for a robot stay rooms that lasers look into; within, as surveyed.
/// @param traced    cells' frame, and which of them are floor or stand on it (FloorPlan::building)
/// @param surveyed  its resolution is the result's
[[nodiscard]] OccupancyGrid with_given_map(const OccupancyGrid& given, const GridFrame& traced,
                                           const std::vector<bool>& building, const OccupancyGrid& surveyed);

}  // namespace docent::simulator
