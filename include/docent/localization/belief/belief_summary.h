#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "docent/geometry/pose2.h"

namespace docent::localization {

/// A Gaussian part of a belief.
struct BeliefMode {
  Pose2 map_from_robot;                ///< mean
  std::array<double, 9> covariance{};  ///< row-major x, y [m], theta [rad]
  double mass = 0.0;                   ///< its share of all probability
};

/// The belief in few numbers (architecture 10.5).
struct BeliefSummary {
  /// One state; theta in [rad], mass as probability.
  struct Cell {
    float x = 0, y = 0, theta = 0, mass = 0;  ///< [m], map; [rad]; probability
  };
  std::vector<Cell> cells;              ///< the likeliest states, by falling mass
  Point2 rest_origin;                   ///< the rest: coarse cells, lower left corner [m]
  double rest_cell_size = 1.0;          ///< [m]
  int rest_columns = 0, rest_rows = 0;  ///< of `rest`
  std::vector<float> rest;              ///< [rows * columns] mass, all headings together
  std::vector<BeliefMode> modes;        ///< by falling mass, at most eight
  double entropy = 0.0;                 ///< [nat]
  double active_mass = 1.0;             ///< of what is updated one by one: grid states above the threshold, particles
  std::size_t active_states = 0;        ///< their number
};

/// How much of a belief its summary holds.
struct SummaryParams {
  std::size_t most_cells = 8192;  ///< of `BeliefSummary::cells`
  double enough_mass = 0.998;     ///< stop listing cells here
  double rest_cell_size = 1.0;    ///< [m]
  double mode_radius = 0.5;       ///< [m]
  double mode_turn = 15.0;        ///< [deg]
};

/// Fills `summary.modes` from its cells: the likeliest cell gathers what lies near it, then the likeliest of the rest.
/// O(cells * modes).
void find_modes(BeliefSummary& summary, const SummaryParams& params);

/// The belief of a robot that has moved on since; its rest, in coarse cells, stays. O(cells).
[[nodiscard]] BeliefSummary carried_on(BeliefSummary belief, const Pose2& before_from_now);

}  // namespace docent::localization
