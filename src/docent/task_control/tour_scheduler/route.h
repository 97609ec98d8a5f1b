#pragma once

#include <span>
#include <vector>

#include "docent/geometry/pose2.h"
#include "docent/task_control/tour_scheduler/programme.h"

namespace docent::task_control {

/// Length [m] of the way from `start` through `points` in the order of `order` (indices into `points`).
[[nodiscard]] double route_length(Point2 start, std::span<const Point2> points, std::span<const std::size_t> order,
                                  const TravelDistance& travel);

/// The order in which to visit all `points` from `start` with the least travel; the way back is not counted. This is
/// the sequencing problem of [Rhino1999] 4.3 and Fig. 22.
/// Exact up to kExactStops points (Held and Karp, O(2^n n^2)), then nearest neighbour improved by moving and reversing
/// stretches until nothing gets shorter, O(n^3) a round. Deterministic: ties go to the lower index.
[[nodiscard]] std::vector<std::size_t> shortest_order(Point2 start, std::span<const Point2> points,
                                                      const TravelDistance& travel);
inline constexpr std::size_t kExactStops = 9;

}  // namespace docent::task_control
