#pragma once

#include <cstdint>
#include <vector>

#include "docent/sensor_models/range_sweep.h"

namespace docent::localization {

/// 1 for every beam of the sweep that ended on a straight, unbroken surface of at least `length` [m]: a wall, whether
/// the map holds it or not. People stand in rows, but not in lines of 6 cm. Runs of neighbours are split where they
/// leave their chord most. Beams are in the order in which the lasers went round; the last is the neighbour of the
/// first. O(beams log beams) for most sweeps, O(beams^2) at worst.
[[nodiscard]] std::vector<std::uint8_t> on_straight_walls(const sensor_models::RangeSweep& sweep, double length = 1.5);

}  // namespace docent::localization
