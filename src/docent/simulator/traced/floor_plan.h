#pragma once

#include <span>
#include <vector>

#include "docent/base/result.h"
#include "docent/geometry/polygon.h"
#include "docent/grid/occupancy_grid.h"

namespace docent::simulator {

/// What a map says of a building, as simplified outlines.
struct FloorPlan {
  Polygon floor;                 ///< [m], counter-clockwise: the open floor that hangs together
  std::vector<Polygon> islands;  ///< [m], counter-clockwise: what stands on it, and courts that nobody enters
  GridFrame frame;
  std::vector<bool> building;  ///< cells of the floor and of what stands on it
};

struct FloorPlanParams {
  double passage = 0.75;       ///< [m] what is narrower is closed: gaps in clutter, rays through a window
  double tolerance = 0.1;      ///< [m] of outlines
  double least_floor = 20.0;   ///< [m2]
  double least_island = 0.01;  ///< [m2] smaller things are noise
};

/// Traces a map. What is not known to be free counts as solid. Error: no open floor of that size. O(cells).
[[nodiscard]] Result<FloorPlan> trace_floor(const OccupancyGrid& map, const FloorPlanParams& params);

/// The largest part of the building that keeps `rim` [m] from its outline and from `kept_off`: where a robot may be.
[[nodiscard]] Polygon trace_area(const FloorPlan& plan, std::span<const Polygon> kept_off, double rim,
                                 double tolerance);

/// Numbers the regions of set cells that hang together by their sides from 1; 0 where none is set. O(cells).
[[nodiscard]] std::vector<int> label_regions(const GridFrame& frame, const std::vector<bool>& cells);

}  // namespace docent::simulator
