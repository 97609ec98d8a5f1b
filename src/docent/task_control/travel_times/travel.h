#pragma once

#include "docent/planning/value_iteration/route.h"
#include "docent/task_control/travel_times/travel_distance.h"

namespace docent::task_control {

/// Travel on the map, round walls and hazards, by the planner's own costs [m of free floor]. The field of values of
/// each destination is computed when it is first asked for and kept: one value iteration, then O(1). A start where the
/// robot cannot be counts from the nearest open cell, and as the crow flies when there is none within `kNear`.
[[nodiscard]] TravelDistance travel_on_map(planning::RoutePlanner planner);
inline constexpr double kNear = 0.6;  ///< [m]

}  // namespace docent::task_control
