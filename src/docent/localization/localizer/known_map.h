#pragma once

#include "docent/grid/occupancy_grid.h"
#include "docent/localization/belief/place_search.h"
#include "docent/localization/expected_ranges/floor_map.h"
#include "docent/localization/expected_ranges/range_table.h"
#include "docent/localization/expected_ranges/range_table_cache.h"
#include "docent/localization/expected_ranges/state_space.h"
#include "docent/localization/localizer/localizer_params.h"
#include "docent/sensor_models/proximity_model.h"
#include "docent/sensor_models/ray_caster.h"

namespace docent::localization {

/// The range table of a map, from the cache where it has one for these parameters; else made, and kept there.
[[nodiscard]] RangeTable range_table_of(const FloorMap& map, const LocalizerParams& params,
                                        const RangeTableCache& cache, const StateSpace& space,
                                        const sensor_models::RayCaster& caster);

/// A map as a belief uses it: the poses in it, what the lasers expect at each, and how probable other readings are.
struct KnownMap {
  /// `cache`: see range_table_of. @pre params are valid
  KnownMap(const FloorMap& map, const LocalizerParams& params, const RangeTableCache& cache);

  sensor_models::RayCaster caster;
  PlaceSearch places;
  StateSpace space;
  RangeTable table;
  sensor_models::ProximityModel model;  ///< p(s | l), [Markov1998] 3.2
  double widest;                        ///< [m] from corner to corner
};

}  // namespace docent::localization
