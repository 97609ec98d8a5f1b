#pragma once

#include "docent/mapping/topological/topological_map.h"
#include "docent/pictures/figure.h"

namespace docent::apps::rooms_command {

/// The map with a colour for each place (hallways are grey), its number, and a line through each door from place to
/// place.
[[nodiscard]] pictures::Figure draw_rooms(const OccupancyGrid& map, const mapping::TopologicalMap& rooms);

}  // namespace docent::apps::rooms_command
