#pragma once

#include <span>

#include "docent/collision_avoidance/body/obstacle.h"
#include "docent/geometry/pose2.h"

namespace docent::collision_avoidance {

struct CarrotParams {
  double step = 0.1;          ///< [m] between the places of the path that are looked at
  double open_enough = 0.7;   ///< [m] when no more of a path can be reached straight on which somebody stands, go round
  double here = 0.15;         ///< [m] so near the robot has nothing to steer for
  double nearly_free = 0.05;  ///< [m] a straight way may end so much before a place and still reach it
  /// [m] of its margins that a path may lack in a narrow door, by noise and the cells it was planned over: nobody
  /// stands on it, and the robot steers by it, not for what lies behind the door's frame
  double nearly_open = 0.05;
};

/// What the robot steers for: a point that runs ahead of it along its path.
struct Carrot {
  Point2 in_base;          ///< [m]
  double remaining = 0.0;  ///< [m] along the path to its end
};

/// The farthest point of the path within the lookahead that can be reached straight, so that corners are not cut, not
/// even out of a niche; the lookahead's end when the path is blocked soon, for then the robot must go round.
/// O(path / step * obstacles).
/// @param path  via-points, base frame @param lookahead  [m] @param radius  [m] of the robot
/// @pre the path is not empty
[[nodiscard]] Carrot carrot_on(std::span<const Point2> path, double lookahead, std::span<const Obstacle> obstacles,
                               double radius, const CarrotParams& params = {});

}  // namespace docent::collision_avoidance
