#pragma once

#include <span>
#include <vector>

#include "docent/geometry/pose2.h"

namespace docent {

/// Which points of a sweep lie on straight pieces of at least 0.75 m: walls and long sides of things, never
/// people. Iterative end point fit [BorgesAldon2004]: a piece is split at its point farthest from the line between its
/// ends, until none lies farther than 7 cm.
/// @param points  in the order of their bearings
/// @param ranges  [points] [m] from the sensor
/// O(points * log points) where pieces are halved, O(points^2) at worst.
[[nodiscard]] std::vector<bool> on_straight_pieces(std::span<const Point2> points, std::span<const double> ranges,
                                                   double bearing_step);

}  // namespace docent
