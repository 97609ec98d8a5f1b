#pragma once

#include <string>
#include <vector>

#include "docent/base/random.h"
#include "docent/grid/occupancy_grid.h"
#include "docent/simulator/world/world.h"

namespace docent::simulator {

struct SurveyParams {
  double resolution = 0.05;      ///< [m] a cell
  double least_error = 0.01;     ///< [m], shift of every solid, in a direction of its own
  double greatest_error = 0.03;  ///< [m]
  double margin = 0.5;           ///< [m] of unknown round the building
  double moved_share = 0.35;     ///< of the movable furniture: has been moved since
  double missing_share = 0.25;   ///< of the movable furniture: is not on the map
  double least_move = 0.15;      ///< [m]
  double greatest_move = 0.35;   ///< [m]
};

/// What lasers do not see, with its place as surveyed. The museum package has its own type: they share a file's form
/// only.
struct SurveyedHazard {
  std::string id;
  std::string kind;  ///< glass, plate, stairs, other
  Polygon polygon;   ///< [m], map
};

/// What the museum's staff would hand to the robot: a map of what lasers see and a list of what they do not, both
/// slightly wrong (architecture 10.1).
struct Survey {
  OccupancyGrid map;
  std::vector<SurveyedHazard> hazards;  ///< glass, plates, stairs, and furniture too low for the lasers
  std::vector<std::string> moved;
  std::vector<std::string> missing;
};

/// Surveys the true world. Every solid is shifted by least_error..greatest_error; a share of the movable furniture is
/// drawn elsewhere, another share not at all (at least one of each where there are three). Deterministic for a seed.
[[nodiscard]] Survey survey(const World& world, const SurveyParams& params, const Rng& rng);

/// The hazards as the block `hazards:` of a museum.yaml, centimetres.
[[nodiscard]] std::string to_yaml(const std::vector<SurveyedHazard>& hazards);

}  // namespace docent::simulator
