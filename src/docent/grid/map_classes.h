#pragma once

#include <string>

#include "docent/grid/occupancy_grid.h"

namespace docent {

/// What a map's cells were taken for, as shares of all of them.
struct MapClasses {
  double free = 0.0;
  double unknown = 0.0;  ///< with what is neither free nor occupied enough
  double occupied = 0.0;
  double free_rim = 0.0;  ///< share of the picture's outermost cells that are free

  /// "46 % free, 50 % unknown, 4 % occupied".
  [[nodiscard]] std::string text() const;
  /// What a person should look at before a robot believes the map; empty: nothing.
  [[nodiscard]] std::string warning() const;
};

/// @pre the map has cells
[[nodiscard]] MapClasses classes_of(const OccupancyGrid& map);

}  // namespace docent
