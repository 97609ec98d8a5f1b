#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "docent/base/result.h"
#include "docent/grid/occupancy_grid.h"

namespace docent::planning {

struct ExplorerParams {
  int coarsening = 2;           ///< planning cell = so many map cells
  double robot_radius = 0.265;  ///< [m]
  double wall_margin = 0.10;    ///< [m] kept from what is known to be occupied, beyond the radius
  double comfort = 0.5;         ///< [m] beyond which clearance costs nothing
  double comfort_cost = 2.0;    ///< extra cost, as a factor, at the least clearance
  double switch_cost = 0.5;     ///< [m of free floor] by which another place must be nearer than the last one
  template <class V>
  void visit(V& v) {
    v("coarsening", coarsening);
    v("robot_radius", robot_radius);
    v("wall_margin", wall_margin);
    v("comfort", comfort);
    v("comfort_cost", comfort_cost);
    v("switch_cost", switch_cost);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// Where to go to learn the map, and how.
struct Exploration {
  std::vector<Point2> way;   ///< [m], map: cell by cell over known free floor, start excluded; the last one is unknown
  double cost = 0.0;         ///< [m of free floor]
  std::size_t frontier = 0;  ///< unknown cells that border on free floor, as far as the robot could stand there
};

/// Exploration ([Buhmann1995], "Planning and Exploration"): value iteration whose goals are the unknown places, all at
/// once, so the robot moves straight to the unexplored. Goals are those unknown cells that border on free floor and are
/// wide enough for the robot, by what is known to be occupied: a crack between a case and the wall is none. A cell that
/// is still unknown when the robot stands right before it cannot be seen, and is not gone to again.
class Explorer {
 public:
  explicit Explorer(ExplorerParams params) : params_{params} {}

  /// @param map    what is known now, with all that is seen from `robot`; it may have grown or moved since the last
  /// call
  /// @param robot  [m], map
  /// @returns nullopt when nothing unknown can be reached: the map is done. O(cells)
  [[nodiscard]] std::optional<Exploration> next(const OccupancyGrid& map, Point2 robot);

 private:
  [[nodiscard]] bool is_given_up(Point2 place, double within) const;

  ExplorerParams params_;
  std::vector<Point2> given_up_;  ///< [m], map
  std::optional<Point2> last_;    ///< [m], map: the goal before
};

}  // namespace docent::planning
