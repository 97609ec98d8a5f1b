#pragma once

#include "docent/pictures/image.h"
#include "docent/pictures/map_picture.h"
#include "docent/simulator/world/world.h"

namespace docent::simulator {

/// The true museum as a plan: floor, operating area, solids by kind with their names where there is room, attractions,
/// entrances and home.
[[nodiscard]] Image draw_world(const World& world, const MapView& view);
/// All of it, the longer side `longest_side` pixels long.
[[nodiscard]] Image draw_world(const World& world, int longest_side = 1200);

}  // namespace docent::simulator
