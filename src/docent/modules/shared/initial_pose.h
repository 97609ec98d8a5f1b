#pragma once

#include <functional>

#include "docent/grid/occupancy_grid.h"
#include "docent/localization/belief/belief_summary.h"
#include "docent/transport/bus.h"

namespace docent::modules {

/// How exactly somebody who points at a map can say where the robot stands. What they claim may be less exact, not
/// more: many tools send zeros.
struct InitialPoseParams {
  double least_position = 0.1;  ///< [m] standard deviation, as `localize.sonar.start_position_error`
  double least_heading = 3.0;   ///< [deg] likewise
};

/// Subscribes to `initialpose`: a person says where the robot stands, and how surely. A place outside the map or off
/// its free floor is refused, which the module's health tells.
/// @param map   outlives the bus
/// @param take  gets the pose as the one mode of a belief, and when it was said; returns why it cannot be taken now
void subscribe_initial_pose(transport::Bus& bus, const OccupancyGrid& map,
                            std::function<MessageFault(const localization::BeliefMode& mode, Time stamp)> take,
                            const InitialPoseParams& params = {});

}  // namespace docent::modules
