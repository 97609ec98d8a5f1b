#pragma once

#include "docent/messages/visualization_messages.h"
#include "docent/museum/museum.h"

namespace docent::visualization {

/// The border of the area in which the robot may be ("area") and the outline of each hazard ("hazards"), as closed
/// lines on the floor of the map.
[[nodiscard]] visualization_msgs::MarkerArray museum_markers(const museum::Museum& museum);

}  // namespace docent::visualization
