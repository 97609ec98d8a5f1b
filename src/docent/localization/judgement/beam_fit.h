#pragma once

#include <vector>

#include "docent/localization/judgement/part_sums.h"
#include "docent/sensor_models/range_sweep.h"
#include "docent/sensor_models/ray_caster.h"

namespace docent::localization {

/// How readings are held against a map whose walls may be off by decimetres.
struct BeamFitParams {
  double max_range = 10.0;  ///< [m]
  double part = 1.0;        ///< [m] side of a part of the floor: what stands there and is not in the map
  double wall_part = 0.5;   ///< [m] of a wall: what is not where the map says
};

/// What a sweep says against a pose: readings that pass through walls, that end where there is nothing, or that come
/// back from nowhere though a wall is well within reach. What fits costs nothing, whether near to walls or far from
/// them. O(beams), three rays each.
[[nodiscard]] std::vector<PartCost> beam_costs(const sensor_models::RayCaster& caster,
                                               const sensor_models::RangeSweep& sweep, const Pose2& map_from_robot,
                                               const BeamFitParams& params);

}  // namespace docent::localization
