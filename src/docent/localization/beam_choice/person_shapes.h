#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "docent/sensor_models/range_sweep.h"

namespace docent::localization {

/// 1 for every beam of the sweep that ended on something shaped like a person, whether the map holds it or not: slim
/// and standing before what is behind it (legs, bodies, also posts), or, side by side with others or half hidden by
/// them, as round as a body. Straight faces of 0.7 m and more are none, nor is what is seen through a gap between two
/// nearer things. It needs no pose: what the filters of [Markov1998] 3.3 ask of a belief is asked of the shape alone.
/// Beams are in the order in which the lasers went round. O(beams log beams) for most sweeps.
[[nodiscard]] std::vector<std::uint8_t> on_person_shapes(const sensor_models::RangeSweep& sweep);

/// The sweep without the beams that are marked. @pre as many marks as beams
[[nodiscard]] sensor_models::RangeSweep without(const sensor_models::RangeSweep& sweep,
                                                std::span<const std::uint8_t> marks);

}  // namespace docent::localization
