#pragma once

#include <span>

namespace docent::collision_avoidance {

/// How far the robot's frame itself may be off, because nobody knows better where its scanners are mounted: the belief
/// of a robot that sees with them does not show it.
struct MountDoubt {
  double heading = 0.0;   ///< [rad], >= 0, each way
  double position = 0.0;  ///< [m], >= 0
  double keep = 0.0;      ///< [m], >= 0: doubt lowers nothing below it, so that the robot may leave
};

/// Lowers ranges that go all round [directions] so that they underestimate whichever way the frame is off: in every
/// direction to the least within the heading's doubt, less that of the position. O(directions * doubt)
void lower_by_doubt(std::span<double> ranges, const MountDoubt& doubt);

}  // namespace docent::collision_avoidance
