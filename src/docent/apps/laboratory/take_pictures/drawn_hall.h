#pragma once

#include <cstdint>

#include "docent/simulator/world/world.h"

namespace docent::apps::take_pictures_command {

struct HallOptions {
  double length = 40.0;    ///< [m], along x
  double width = 30.0;     ///< [m], along y
  double height = 3.5;     ///< [m] of its ceiling
  double opening = 0.0;    ///< [m] so much higher is the ceiling over its middle; 0: there is no opening
  std::uint64_t seed = 1;  ///< of columns, exhibits and, unless it is set, of the ceiling
};

/// An empty hall with walls, some columns and exhibits, its lower left corner at the origin.
[[nodiscard]] simulator::World drawn_hall(const HallOptions& options);

}  // namespace docent::apps::take_pictures_command
