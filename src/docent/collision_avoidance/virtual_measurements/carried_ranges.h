#pragma once

#include "docent/collision_avoidance/virtual_measurements/virtual_measurements.h"
#include "docent/geometry/pose2.h"

namespace docent::collision_avoidance {

/// What was measured from one pose, as the robot sees it from another one nearby: what the rays ended on stands where
/// it stood, and neighbouring ends belong to one edge. What nothing was measured of stays free. O(kDirections).
/// @param then_from_now  the way since, by odometry: some decimetres, for what lay behind a corner is not seen
[[nodiscard]] VirtualMeasurements::Ranges carried(const VirtualMeasurements::Ranges& measured,
                                                  const Pose2& then_from_now);

}  // namespace docent::collision_avoidance
