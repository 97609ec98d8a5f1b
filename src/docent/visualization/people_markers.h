#pragma once

#include "docent/messages/docent_messages.h"
#include "docent/messages/visualization_messages.h"

namespace docent::visualization {

/// How a person is drawn. Nothing that the robot does depends on it.
struct PeopleMarkerParams {
  double diameter = 0.5;      ///< [m] of the cylinder: shoulders
  double height = 1.7;        ///< [m]
  double arrow_time = 1.0;    ///< [s] the arrow ends where the person is then
  double arrow_width = 0.08;  ///< [m] of its shaft; the head is twice as wide
  double least_speed = 0.1;   ///< [m/s] slower people have no arrow: it would be shorter than its head
  double lifetime = 1.0;      ///< [s] after which a viewer removes who is not tracked any more
};

/// For each person a cylinder ("people") and, when they walk, an arrow ("velocities"), both with the track's number.
/// People of a group are blue, others orange.
[[nodiscard]] visualization_msgs::MarkerArray people_markers(const docent_msgs::People& people,
                                                             const PeopleMarkerParams& params = {});

}  // namespace docent::visualization
