#pragma once

#include <cstdint>
#include <string>

#include "docent/base/result.h"
#include "docent/grid/occupancy_grid.h"
#include "docent/simulator/museum_folder/museum_folder.h"

namespace docent::simulator {

/// A museum in the building that a map shows: its outlines as walls and things of a height that nobody drew, and, drawn
/// with the seed, what a map cannot show (glass cases on podiums, plates, a staircase), benches, places to show
/// something, entrances, home and charger. All places keep half a metre from things, also once the survey has moved
/// them. Deterministic for a map and a seed. Error: no room for a museum.
[[nodiscard]] Result<MuseumPlan> trace_museum(const OccupancyGrid& map, const std::string& title, std::uint64_t seed);

}  // namespace docent::simulator
