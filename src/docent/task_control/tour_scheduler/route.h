#pragma once

#include <span>
#include <vector>

#include "docent/geometry/pose2.h"
#include "docent/task_control/tour_scheduler/programme.h"

namespace docent::task_control {

/// Places of which one is to be visited [m, map]. Never empty.
using StopPlaces = std::vector<Point2>;

/// A stop of a route: its index among the stops, and which of its places.
struct RouteStop {
  std::size_t stop = 0;
  std::size_t place = 0;
  friend bool operator==(const RouteStop&, const RouteStop&) = default;
};

/// Length [m] of the way from `start` along the route.
[[nodiscard]] double route_length(Point2 start, std::span<const StopPlaces> stops, std::span<const RouteStop> route,
                                  const TravelDistance& travel);

/// The order in which to visit all `stops` from `start`, each at one of its places, with the least travel; the way back
/// is not counted. This is the sequencing problem of [Rhino1999] 4.3 and Fig. 22, generalised to groups of places.
///
/// Exact up to kExactStops stops with kExactPlaces places p in all, by dynamic programming over sets of stops (Held and
/// Karp): O(2^n p^2) time, O(2^n p) space; 15 stops cost 13 ms with one place each, 64 ms with four (route_benchmark).
/// With more, a nearest-neighbour route is improved by moving and reversing stretches until nothing gets shorter, the
/// places being the best ones for each order: O(n^2 p) a round. Deterministic: ties go to the lower index.
[[nodiscard]] std::vector<RouteStop> shortest_route(Point2 start, std::span<const StopPlaces> stops,
                                                    const TravelDistance& travel);
inline constexpr std::size_t kExactStops = 15;
inline constexpr std::size_t kExactPlaces = 64;

}  // namespace docent::task_control
