#pragma once

#include <vector>

#include "docent/geometry/polygon.h"
#include "docent/grid/occupancy_grid.h"

namespace docent::planning {

/// How much room a map and the border of an area leave for the robot's centre, at the middle of every cell of the map.
/// Ways are planned over coarser cells, and a door may be one of them wide or less: in each of those the place with the
/// most room counts, or a door would be open or shut by where the grid happens to lie.
class StandingRoom {
 public:
  /// @param area  [m], map; empty: anywhere
  /// @param reach  [m], > 0: a border that is farther away than that lies so far away. O(cells + sides * reach)
  StandingRoom(const OccupancyGrid& map, const Polygon& area, double reach);

  struct Place {
    Point2 at;            ///< [m], map
    double walls = 0.0;   ///< [m] from there to the middle of what is known to be occupied
    double border = 0.0;  ///< [m] to the area's border; < 0 outside
  };
  /// The place with the most room in a cell that is `coarsening` times as wide as the map's; its middle where there is
  /// plenty all over. O(coarsening^2)
  /// @param beyond  the border may be so much nearer [m] than walls
  [[nodiscard]] Place best_in(CellIndex coarse, int coarsening, double beyond) const;

 private:
  void measure_border(const Polygon& area, double reach);

  GridFrame frame_;
  std::vector<float> walls_;   ///< [m], of every cell
  std::vector<float> border_;  ///< [m]; < 0 outside; empty: there is none
};

}  // namespace docent::planning
