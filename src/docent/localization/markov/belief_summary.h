#pragma once

#include <cstdint>
#include <vector>

#include "docent/localization/markov/position_belief.h"

namespace docent {

/// The belief in few numbers (architecture 10.5).
struct BeliefSummary {
  struct Cell {
    float x = 0, y = 0, theta = 0, mass = 0;
  };
  std::vector<Cell> cells;      ///< the likeliest states, by falling mass
  Point2 rest_origin;           ///< the rest: coarse cells, lower left corner [m]
  double rest_cell_size = 1.0;  ///< [m]
  int rest_columns = 0, rest_rows = 0;
  std::vector<float> rest;        ///< [rows * columns] mass, all headings together
  std::vector<BeliefMode> modes;  ///< by falling mass, at most eight
  double entropy = 0.0;           ///< [nat]
};

struct SummaryParams {
  std::size_t most_cells = 8192;
  double enough_mass = 0.998;   ///< stop listing cells here
  double rest_cell_size = 1.0;  ///< [m]
  double mode_radius = 0.5;     ///< [m]
  double mode_turn = 15.0;      ///< [deg]
};

/// Of the robot's pose, where the belief is over a frame with `frame_from_robot`. O(kept states).
[[nodiscard]] BeliefSummary summarise(const PositionBelief& belief, const Pose2& frame_from_robot,
                                      const SummaryParams& params);

}  // namespace docent
