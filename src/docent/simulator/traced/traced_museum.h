#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/grid/occupancy_grid.h"
#include "docent/simulator/museum_folder/museum_folder.h"
#include "docent/simulator/museum_folder/places.h"
#include "docent/simulator/traced/pedestrian_fit.h"

namespace docent::simulator {

struct TracedMuseum {
  MuseumPlan plan;
  GridFrame frame;                  ///< of the cells below
  std::vector<bool> building;       ///< floor that a robot may reach, and what stands on it
  std::vector<PedestrianFit> fits;  ///< one a recording; what they keep is in the plan's world
  std::size_t carried_away = 0;     ///< small things of the map that stood in the way of recorded people
};

/// A museum in the building that a map shows: its outlines as walls and things of a height that nobody drew, and, drawn
/// with the seed, what a map cannot show (glass cases on podiums, plates, a staircase), benches, places to show
/// something, entrances, home and charger. All places keep half a metre from things, also once the survey has moved
/// them. Deterministic for a map and a seed.
///
/// Recordings are fitted between the building's fixed parts; what is small and stands where their people walk is
/// carried away, and nothing is put there. Error: no room for a museum.
/// @param places  what somebody says of the building instead: its stops and hazards are these, home and charger too
///                where they are said
[[nodiscard]] Result<TracedMuseum> trace_museum(const OccupancyGrid& map, std::span<const Recording> recordings,
                                                const std::string& title, std::uint64_t seed,
                                                const std::optional<Places>& places = std::nullopt);

}  // namespace docent::simulator
