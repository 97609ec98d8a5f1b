#pragma once

#include <string>
#include <vector>

#include "docent/base/random.h"
#include "docent/simulator/world/world.h"

namespace docent::simulator {

/// A place in a corridor where a robot may stop.
struct OfficeStop {
  std::string id;
  Pose2 pose;      ///< world_from_base, facing what it shows
  Point2 look_at;  ///< [m], world
};

/// An office building: one corridor or a ring of corridors, rooms along them, doors, furniture.
struct Office {
  World world;
  std::vector<OfficeStop> stops;  ///< at least two
  Pose2 home;                     ///< world_from_base, in a corridor
};

/// Draws a building: 24 to 40 m long, mostly rectangular and turned by any angle, walls smooth, rooms open or shut,
/// cabinets and copiers in the corridors. Two people's worth of passage (1.3 m) stays free in corridors, a metre in
/// doors. Every draw comes from `rng`; deterministic for a seed.
[[nodiscard]] Office draw_office(const Rng& rng);

}  // namespace docent::simulator
