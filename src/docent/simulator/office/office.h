#pragma once

#include "docent/base/random.h"
#include "docent/simulator/museum_folder/museum_folder.h"

namespace docent::simulator {

/// An office building: one corridor or a ring of corridors, rooms along them, doors, furniture. Home and stops lie in
/// corridors.
using Office = MuseumPlan;

/// Draws a building: 24 to 40 m long, mostly rectangular and turned by any angle, walls smooth, rooms open or shut,
/// cabinets and copiers in the corridors. Two people's worth of passage (1.3 m) stays free in corridors, a metre in
/// doors. Deterministic for a seed.
[[nodiscard]] Office draw_office(std::uint64_t seed);

}  // namespace docent::simulator
