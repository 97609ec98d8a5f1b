#include "docent/mapping/occupancy/stray_floor.h"

#include <array>
#include <vector>

namespace docent::mapping {

void forget_stray_floor(OccupancyGrid& map, double least) {
  constexpr std::array<CellIndex, 4> kBeside{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
  const double cell_m2 = map.frame.resolution * map.frame.resolution;
  std::vector<bool> is_seen(map.frame.size(), false);
  std::vector<CellIndex> piece;
  for (int row = 0; row < map.frame.rows; ++row) {
    for (int column = 0; column < map.frame.columns; ++column) {
      if (is_seen[map.frame.index({column, row})] || !map.is_free({column, row})) continue;
      piece.assign(1, {column, row});
      is_seen[map.frame.index({column, row})] = true;
      for (std::size_t i = 0; i < piece.size(); ++i) {
        for (const CellIndex step : kBeside) {
          const CellIndex next{piece[i].column + step.column, piece[i].row + step.row};
          if (!map.is_free(next) || is_seen[map.frame.index(next)]) continue;
          is_seen[map.frame.index(next)] = true;
          piece.push_back(next);
        }
      }
      if (static_cast<double>(piece.size()) * cell_m2 >= least) continue;
      for (const CellIndex cell : piece) map.cells[map.frame.index(cell)] = OccupancyGrid::kUnknown;
    }
  }
}

}  // namespace docent::mapping
