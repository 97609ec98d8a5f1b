#pragma once

#include <span>
#include <vector>

#include "docent/base/result.h"
#include "docent/geometry/polygon.h"
#include "docent/grid/occupancy_grid.h"

namespace docent {

/// How much room a place must leave for the robot to be driven to and through: what the check of a museum calls fine,
/// the planner plans through, and what the planner plans through, collision avoidance lets a well-localized robot pass.
///
/// The body keeps off walls and hazards. The area's border binds its centre alone: the body may reach over it.
struct Clearance {
  double walls = 0.10;  ///< [m] beyond the body, to what the map shows; avoidance keeps real_margin, sensed
  /// [m] beyond the body, to hazards. Avoidance keeps virtual_margin (0.15) to virtual measurements, which are short by
  /// half a belief cell (0.05), by their bins (up to 0.05) and by the spread of a sure belief (0.05).
  double hazards = 0.30;
  /// [m] from the centre to the area's border. Avoidance keeps border_margin (0.07); bins and spread as above.
  double border = 0.20;
  template <class V>
  void visit(V& v) {
    v("walls", walls);
    v("hazards", hazards);
    v("border", border);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// Room to spare [m] for a disc's centre at the centre of every cell of a grid `coarsening` times coarser than the map:
/// >= 0 where the robot can be, negative where it cannot, -infinity outside the map or the area. What the map does not
/// know counts as solid. An empty area is everywhere. O(cells * (hazards + corners of the area)).
[[nodiscard]] std::vector<double> spare_room(const OccupancyGrid& map, std::span<const Polygon> hazards,
                                             const Polygon& area, double robot_radius, const Clearance& clearance,
                                             int coarsening);

/// The grid of `spare_room`.
[[nodiscard]] GridFrame coarse_frame(const GridFrame& fine, int coarsening);

}  // namespace docent
