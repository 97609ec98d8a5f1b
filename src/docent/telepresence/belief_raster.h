#pragma once

#include <cstdint>
#include <vector>

#include "docent/geometry/pose2.h"
#include "docent/messages/localization_messages.h"

namespace docent::telepresence {

/// The belief over x and y, all headings together, as a picture of one byte a cell.
struct BeliefRaster {
  Point2 origin;      ///< [m], map: lower left
  double cell = 0.0;  ///< [m]
  int columns = 0;    ///< 0: nothing to show
  int rows = 0;
  std::vector<std::uint8_t> levels;  ///< [rows * columns], 255 sqrt(mass / largest mass), row 0 lowest
};

/// The smallest raster of cells of `cell` metres that holds all mass that shows; coarsened until it has at most
/// `max_cells` cells. What the coarse part of the belief holds is spread evenly over each of its cells.
[[nodiscard]] BeliefRaster belief_raster(const docent_msgs::Belief& belief, double cell = 0.3, int max_cells = 60000);

}  // namespace docent::telepresence
