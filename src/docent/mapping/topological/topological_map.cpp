#include "docent/mapping/topological/topological_map.h"

#include <algorithm>

namespace docent::mapping {

std::vector<int> TopologicalMap::neighbours(int place) const {
  std::vector<int> result;
  for (const int door : places[static_cast<std::size_t>(place)].doors) {
    const Gap& gap = regions.gaps[static_cast<std::size_t>(door)];
    result.push_back(gap.first == place ? gap.second : gap.first);
  }
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

TopologicalMap topological_map(const OccupancyGrid& map, const RegionParams& params) {
  TopologicalMap result{cut_into_regions(map, params), {}};
  const Regions& regions = result.regions;
  result.places.resize(static_cast<std::size_t>(regions.count));
  std::vector<double> clearance(result.places.size(), 0.0);  // [m3], summed over the area
  std::vector<float> widest(result.places.size(), 0.0F);
  const double cell_area = map.frame.resolution * map.frame.resolution;
  for (int row = 0; row < map.frame.rows; ++row) {
    for (int column = 0; column < map.frame.columns; ++column) {
      const std::size_t i = map.frame.index({column, row});
      if (regions.of[i] == Regions::kNone) continue;
      const auto region = static_cast<std::size_t>(regions.of[i]);
      Place& place = result.places[region];
      place.shape.area += cell_area;
      clearance[region] += cell_area * static_cast<double>(regions.clearance[i]);
      if (regions.clearance[i] <= widest[region]) continue;
      widest[region] = regions.clearance[i];
      place.middle = map.frame.centre({column, row});
    }
  }
  for (std::size_t i = 0; i < regions.gaps.size(); ++i)
    for (const int region : {regions.gaps[i].first, regions.gaps[i].second})
      result.places[static_cast<std::size_t>(region)].doors.push_back(static_cast<int>(i));
  for (std::size_t region = 0; region < result.places.size(); ++region) {
    Place& place = result.places[region];
    place.shape.width = 4.0 * clearance[region] / place.shape.area;
    place.shape.elongation = std::max(1.0, place.shape.area / (place.shape.width * place.shape.width));
    place.shape.doors = static_cast<int>(place.doors.size());
    place.kind = kind_of(place.shape, place_examples());
  }
  return result;
}

}  // namespace docent::mapping
