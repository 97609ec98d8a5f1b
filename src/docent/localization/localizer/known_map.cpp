#include "docent/localization/localizer/known_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <thread>

namespace docent::localization {
namespace {

/// All that a table depends on, beside the program: numbers to the last bit.
std::string table_key(const FloorMap& map, const LocalizerParams& params) {
  const StateSpaceParams& states = params.states;
  std::array<char, 128> numbers{};
  std::snprintf(numbers.data(), numbers.size(), " %a %a %a %a %a", states.cell_size, states.heading_step,
                states.min_clearance, states.wall_depth, params.sensor.max_range);
  return map_hash(map.walls) + map_hash(map.standing) + numbers.data();
}

}  // namespace

RangeTable range_table_of(const FloorMap& map, const LocalizerParams& params, const RangeTableCache& cache,
                          const StateSpace& space, const sensor_models::RayCaster& caster) {
  const sensor_models::ProximityModel model{params.sensor};
  const RangeTable::Building how{std::max(1U, std::thread::hardware_concurrency()), {}};
  if (cache.folder.empty()) return RangeTable::build(space, caster, model, how);
  const std::string key = table_key(map, params);
  const std::filesystem::path file = cache.file_of(key);
  RangeTable table = RangeTable::load_or_build(file, key, space, caster, model, how);
  cache.make_room(file);
  return table;
}

KnownMap::KnownMap(const FloorMap& map, const LocalizerParams& params, const RangeTableCache& cache)
    : caster{sensor_models::peeled(map.walls, params.states.wall_depth)},
      places{caster, map.standing},
      space{map.standing, caster, params.states},
      table{range_table_of(map, params, cache, space, caster)},
      model{params.sensor, table.frequency(), params.own_sensor.get()},
      widest{map.walls.frame.resolution * std::hypot(map.walls.frame.columns, map.walls.frame.rows)} {}

}  // namespace docent::localization
