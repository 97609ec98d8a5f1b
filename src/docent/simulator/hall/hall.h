#pragma once

#include "docent/base/random.h"
#include "docent/simulator/world/world.h"

namespace docent::simulator {

/// A hall of a museum that a robot has to cross.
struct Hall {
  World world;
  Pose2 start;  ///< world_from_base, at one end
  Point2 goal;  ///< [m], world, at the other end
};

/// Draws a hall of 14 x 10 m: cases along both long walls and, on the open floor, places where people stand round a
/// guide or talk, two to four of them. The start and the goal lie 11.4 m apart on the hall's axis; no furniture stands
/// between them, people do. Every draw comes from `rng`.
[[nodiscard]] Hall draw_hall(Rng rng);

}  // namespace docent::simulator
