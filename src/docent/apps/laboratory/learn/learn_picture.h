#pragma once

#include <string>

#include "docent/motion_models/odometry_model.h"
#include "docent/pictures/figure.h"
#include "docent/sensor_models/proximity_fit.h"

namespace docent::apps::learn_command {

/// After [Rhino1999] Fig. 4: P(measured | expected) as counted and as learned, side by side, and cuts at three expected
/// ranges with the readings as bars and both models as lines.
[[nodiscard]] pictures::Figure draw_sensor_model(const sensor_models::ReadingCounts& readings,
                                                 const sensor_models::ProximityModelParams& before,
                                                 const sensor_models::ProximityModelParams& learned,
                                                 const std::string& sensor);

/// After [Rhino1999] Fig. 6: where a robot may be after 40 and after 80 m, by odometry alone, along a corridor and
/// round a corner; above by the motion model at the start, below by the learned one.
[[nodiscard]] pictures::Figure draw_motion_model(const motion_models::OdometryModelParams& before,
                                                 const motion_models::OdometryModelParams& learned, std::uint64_t seed);

}  // namespace docent::apps::learn_command
