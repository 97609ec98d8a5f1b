#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "docent/collision_avoidance/obstacle_field/sweep_geometry.h"
#include "docent/geometry/pose2.h"

namespace docent::collision_avoidance {

struct StraightPiecesParams {
  PieceParams piece{};
  double off = 0.07;           ///< [m] from the line at most: noise and half a brick
  double least_length = 0.75;  ///< [m] wider than a person
  std::size_t least_points = 5;
};

/// Which points of a sweep lie on straight pieces that are wider than a person: walls and long sides of things, never
/// people. Iterative end point fit [BorgesAldon2004]: a piece is split at its point farthest from the line between its
/// ends, until none lies off it.
/// @param points  in the order of their bearings
/// @param ranges  [points] [m] from the sensor
/// O(points * log points) where pieces are halved, O(points^2) at worst.
[[nodiscard]] std::vector<bool> on_straight_pieces(std::span<const Point2> points, std::span<const double> ranges,
                                                   double bearing_step, const StraightPiecesParams& params = {});

}  // namespace docent::collision_avoidance
