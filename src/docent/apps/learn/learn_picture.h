#pragma once

#include <string>

#include "docent/motion_models/odometry_model.h"
#include "docent/pictures/figure.h"
#include "docent/sensor_models/proximity_fit.h"

namespace docent {

/// After [Rhino1999] Fig. 4: P(measured | expected) as counted and as learned, side by side, and cuts at three expected
/// ranges with the readings as bars and both models as lines.
[[nodiscard]] Figure draw_sensor_model(const ReadingCounts& readings, const ProximityModelParams& before,
                                       const ProximityModelParams& learned, const std::string& sensor);

/// After [Rhino1999] Fig. 6: where a robot may be after 40 and after 80 m, by odometry alone, along a corridor and
/// round a corner; above by the motion model at the start, below by the learned one.
[[nodiscard]] Figure draw_motion_model(const OdometryModelParams& before, const OdometryModelParams& learned,
                                       std::uint64_t seed);

}  // namespace docent
