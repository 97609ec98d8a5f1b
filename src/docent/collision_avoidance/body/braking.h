#pragma once

#include <span>

#include "docent/collision_avoidance/body/base_motion.h"
#include "docent/collision_avoidance/body/obstacle.h"

namespace docent::collision_avoidance {

/// How the check of the braking looks at the motion.
struct BrakingParams {
  double step = 0.05;            ///< [s] of the simulated motion; the base changes little in it
  double harmless_speed = 0.08;  ///< [m/s] towards what moves: less is no push
  double last_margin = 0.02;     ///< [m] the last bit of margin, which is never given up
  double noise = 0.01;           ///< [m] by which a thing inside the margin may seem to come nearer
  double border_noise = 0.001;   ///< [m] likewise where there is no margin left to give, and at the area's border
};

/// True when the base, moving with `velocity` now, may obey `command` for `hold` [s] and then brake fully (the watchdog
/// does that when we die) without coming nearer to an obstacle than its margin, less `slack` [m].
///
/// The motion is simulated with the base's real accelerations. Inside a margin the base may not get nearer. Things that
/// move are followed at constant velocity until they touch the base, where they stand; they count as long as the base
/// moves towards them.
/// O((hold + braking time) / 50 ms * obstacles).
[[nodiscard]] bool can_brake_in_time(const Velocity& velocity, const Velocity& command, double hold,
                                     std::span<const Obstacle> obstacles, const BaseLimits& limits, double slack,
                                     const BrakingParams& params = {});

}  // namespace docent::collision_avoidance
