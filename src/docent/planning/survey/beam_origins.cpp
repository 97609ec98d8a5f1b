#include "docent/planning/survey/beam_origins.h"

namespace docent::planning {
namespace {

/// Near what is drawn it is that; on floor with free floor all round it is not of the map; else nobody knows.
sensor_models::BeamOrigin origin_of(const OccupancyGrid& map, Point2 end) {
  constexpr int kNear = 3;  // cells
  const CellIndex at = map.frame.cell_at(end);
  bool is_free = true;
  for (int row = at.row - kNear; row <= at.row + kNear; ++row) {
    for (int column = at.column - kNear; column <= at.column + kNear; ++column) {
      if (map.is_occupied({column, row})) return sensor_models::BeamOrigin::map;
      is_free = is_free && map.is_free({column, row});
    }
  }
  return is_free ? sensor_models::BeamOrigin::not_map : sensor_models::BeamOrigin::unknown;
}

}  // namespace

std::vector<sensor_models::BeamOrigin> beam_origins(const OccupancyGrid& map, const sensor_models::RangeSweep& sweep,
                                                    const Pose2& map_from_base) {
  std::vector<sensor_models::BeamOrigin> origins;
  origins.reserve(sweep.beams.size());
  for (const sensor_models::SweepBeam& beam : sweep.beams) {
    origins.push_back(beam.no_return ? sensor_models::BeamOrigin::unknown
                                     : origin_of(map, map_from_base * endpoint(beam)));
  }
  return origins;
}

}  // namespace docent::planning
