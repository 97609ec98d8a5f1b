#pragma once

#include <functional>

#include "docent/museum/museum.h"
#include "docent/task_control/tour_scheduler/programme.h"

namespace docent::task_control {

/// What the museum offers: exhibits with how long their texts are spoken in each language, tours, home and charger.
[[nodiscard]] Programme programme_of(const museum::Museum& museum);
/// Likewise on the museum's map: where the robot has room, and which rooms there are. Without a map as above.
/// @param robot_radius  [m]
[[nodiscard]] Programme programme_on_map(const museum::Museum& museum, double robot_radius,
                                         std::function<const Rooms&()> rooms);
/// How far it is from place to place, round walls and hazards; without a map as the crow flies.
/// @param robot_radius  [m]
[[nodiscard]] TravelDistance travel_in(const museum::Museum& museum, double robot_radius);

}  // namespace docent::task_control
