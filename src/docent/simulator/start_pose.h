#pragma once

#include <optional>

#include "docent/base/random.h"
#include "docent/simulator/crowd/walkable_floor.h"

namespace docent::simulator {

/// A random place inside the operating area from which the home can be reached, at least `clearance` [m] from
/// everything to the robot's centre, hazards included, and at least `away` [m] from `from`; random heading.
/// nullopt when there is none.
[[nodiscard]] std::optional<Pose2> random_start(const World& world, const WalkableFloor& floor, Rng& rng,
                                                double clearance = 0.6, Point2 from = {}, double away = 0.0);

}  // namespace docent::simulator
