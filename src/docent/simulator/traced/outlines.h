#pragma once

#include <vector>

#include "docent/geometry/polygon.h"
#include "docent/grid/occupancy_grid.h"

namespace docent::simulator {

/// To the millimetre, as files hold it: an outline that is simple here is simple when it is read back.
[[nodiscard]] Point2 to_millimetre(Point2 point);

/// Sets cells until no two set cells touch by a corner alone: after it every outline is a simple polygon.
void join_corners(const GridFrame& frame, std::vector<bool>& cells);

/// The outlines of the regions of set cells, along the cells' sides: counter-clockwise round a region, clockwise round
/// a hole in it. Only corners at which the outline turns. @pre join_corners(frame, cells). O(cells).
[[nodiscard]] std::vector<Polygon> trace_outlines(const GridFrame& frame, const std::vector<bool>& cells);

/// The outline with the fewest corners that Douglas and Peucker's way finds within `tolerance` [m] of it, and which is
/// simple: where it is not, the tolerance is halved. O(corners^2).
[[nodiscard]] Polygon simplified(const Polygon& outline, double tolerance);

}  // namespace docent::simulator
