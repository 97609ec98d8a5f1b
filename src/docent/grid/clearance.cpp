#include "docent/grid/clearance.h"

#include <algorithm>
#include <limits>

#include "docent/grid/ground.h"

namespace docent {

Result<void> Clearance::validate() const {
  for (const double room : {walls, hazards, border}) {
    if (!(room >= 0.0)) return fail("clearance: walls, hazards and border must be >= 0 m");
  }
  return {};
}

GridFrame coarse_frame(const GridFrame& fine, int coarsening) {
  return {(fine.columns + coarsening - 1) / coarsening, (fine.rows + coarsening - 1) / coarsening,
          fine.resolution * coarsening, fine.origin};
}

std::vector<double> spare_room(const OccupancyGrid& map, std::span<const Polygon> hazards, const Polygon& area,
                               double robot_radius, const Clearance& clearance, int coarsening) {
  std::vector<bool> solid(map.frame.size());
  for (std::size_t i = 0; i < solid.size(); ++i) solid[i] = map.cells[i] < 0 || map.cells[i] >= 65;
  const auto to_walls = distance_transform(map.frame, solid);
  const GridFrame frame = coarse_frame(map.frame, coarsening);
  std::vector<double> spare(frame.size(), -std::numeric_limits<double>::infinity());
  for (int row = 0; row < frame.rows; ++row) {
    for (int column = 0; column < frame.columns; ++column) {
      const Point2 centre = frame.centre({column, row});
      const CellIndex fine = map.frame.cell_at(centre);
      if (!map.frame.holds(fine)) continue;
      const double room = static_cast<double>(to_walls[map.frame.index(fine)]) - robot_radius - clearance.walls;
      spare[frame.index({column, row})] =
          std::min(room, room_on_ground(area, hazards, centre, robot_radius, clearance));
    }
  }
  return spare;
}

}  // namespace docent
