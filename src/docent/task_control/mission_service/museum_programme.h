#pragma once

#include <functional>
#include <memory>

#include "docent/museum/museum.h"
#include "docent/planning/value_iteration/route.h"
#include "docent/task_control/tour_scheduler/programme.h"

namespace docent::task_control {

/// What the museum offers: exhibits with how long their texts are spoken in each language, tours, home and charger.
[[nodiscard]] Programme programme_of(const museum::Museum& museum);
/// The ways on the museum's map; null without a map. @param robot_radius  [m]
[[nodiscard]] std::shared_ptr<const planning::RoutePlanner> ways_in(const museum::Museum& museum, double robot_radius);
/// As `programme_of`, and on the museum's map: where the robot has room, and which rooms there are.
/// @param ways  null: as `programme_of`
[[nodiscard]] Programme programme_on_map(const museum::Museum& museum,
                                         std::shared_ptr<const planning::RoutePlanner> ways,
                                         std::function<const Rooms&()> rooms);
/// How far it is from place to place, round walls and hazards. @param ways  null: as the crow flies
[[nodiscard]] TravelDistance travel_by(const std::shared_ptr<const planning::RoutePlanner>& ways);

}  // namespace docent::task_control
