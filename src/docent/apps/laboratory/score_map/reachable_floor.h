#pragma once

#include <vector>

#include "docent/simulator/world/world.h"

namespace docent::apps::score_map_command {

/// The floor of a true world that a robot can learn of.
struct ReachableFloor {
  double step = 0.1;          ///< [m] between cells
  std::vector<Point2> cells;  ///< [m], world: middles of cells of floor that are seen from somewhere
};

/// All floor that a laser sees, up to 10 m away, from the largest piece of floor in one over which a robot of 0.365 m
/// radius, its usual margin included, can drive inside the operating area. Takes a second.
[[nodiscard]] ReachableFloor reachable_floor(const simulator::World& world);

}  // namespace docent::apps::score_map_command
