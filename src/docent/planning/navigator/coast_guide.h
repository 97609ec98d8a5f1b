#pragma once

#include <optional>
#include <vector>

#include "docent/grid/occupancy_grid.h"
#include "docent/planning/coastal/coastal_planner.h"
#include "docent/planning/navigator/whereabouts.h"
#include "docent/planning/value_iteration/route.h"

namespace docent::planning {

/// Makes a route prefer the way of the coastal planner, as soon as that has one. Any-time, like the route: when the
/// values have settled, or the robot has been driven off, the way is taken anew.
class CoastGuide {
 public:
  /// Without `params.weight` it does nothing.
  CoastGuide(const OccupancyGrid& map, const RoutePlanner& route, const CoastalParams& params);

  /// Begins to plan to another goal; until it has a way the route is the shortest.
  /// @param tolerance  [m]
  void seek(Point2 goal, double tolerance, RoutePlanner& route);
  /// Plans on for a moment. O(cells * levels).
  void follow(const Whereabouts& where, const PoseBelief& belief, RoutePlanner& route);

 private:
  std::optional<CoastalPlanner> planner_;
  std::vector<Point2> way_;  ///< [m], map; empty: none yet
};

}  // namespace docent::planning
