#include "docent/grid/map_classes.h"

#include <array>
#include <cstdio>

namespace docent {

MapClasses classes_of(const OccupancyGrid& map) {
  const GridFrame& frame = map.frame;
  std::size_t free = 0, occupied = 0, rim = 0, free_rim = 0;
  for (int row = 0; row < frame.rows; ++row) {
    for (int column = 0; column < frame.columns; ++column) {
      const CellIndex cell{column, row};
      const bool is_rim = row == 0 || column == 0 || row + 1 == frame.rows || column + 1 == frame.columns;
      free += map.is_free(cell) ? 1 : 0;
      occupied += map.is_occupied(cell) ? 1 : 0;
      rim += is_rim ? 1 : 0;
      free_rim += is_rim && map.is_free(cell) ? 1 : 0;
    }
  }
  const auto all = static_cast<double>(frame.size());
  MapClasses classes;
  classes.free = static_cast<double>(free) / all;
  classes.occupied = static_cast<double>(occupied) / all;
  classes.unknown = static_cast<double>(frame.size() - free - occupied) / all;
  classes.free_rim = static_cast<double>(free_rim) / static_cast<double>(rim);
  return classes;
}

std::string MapClasses::text() const {
  std::array<char, 80> line{};
  std::snprintf(line.data(), line.size(), "%.3g %% free, %.3g %% unknown, %.3g %% occupied", 100.0 * free,
                100.0 * unknown, 100.0 * occupied);
  return line.data();
}

std::string MapClasses::warning() const {
  constexpr double kOpen = 0.25;  // of the rim: a picture that is cut through a hall has less
  constexpr double kSolid = 0.6;  // of all cells: no building is so much wall
  if (free == 0.0) return "nothing is free: look at negate and free_thresh";
  if (occupied == 0.0) return "nothing is occupied: look at negate and occupied_thresh";
  if (occupied > kSolid) return "most of it is occupied: look at negate and occupied_thresh";
  if (free_rim > kOpen)
    return "the floor is free up to the picture's edge: is what nobody has seen taken for free? Look at free_thresh, "
           "which must be so low that the shade of what is unknown is not free";
  return {};
}

}  // namespace docent
