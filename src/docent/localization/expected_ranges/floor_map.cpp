#include "docent/localization/expected_ranges/floor_map.h"

#include <algorithm>

namespace docent::localization {

FloorMap::FloorMap(const OccupancyGrid& map, std::span<const Polygon> closed) : walls{map}, standing{map} {
  for (const Polygon& polygon : closed) {
    if (polygon.empty()) continue;
    const auto [left, right] =
        std::minmax_element(polygon.begin(), polygon.end(), [](const Point2& a, const Point2& b) { return a.x < b.x; });
    const auto [low, high] =
        std::minmax_element(polygon.begin(), polygon.end(), [](const Point2& a, const Point2& b) { return a.y < b.y; });
    const CellIndex first = map.frame.cell_at({left->x, low->y});
    const CellIndex last = map.frame.cell_at({right->x, high->y});
    for (int row = std::max(0, first.row); row <= std::min(last.row, map.frame.rows - 1); ++row) {
      for (int column = std::max(0, first.column); column <= std::min(last.column, map.frame.columns - 1); ++column) {
        const CellIndex cell{column, row};
        if (standing.is_free(cell) && contains(polygon, map.frame.centre(cell)))
          standing.cells[map.frame.index(cell)] = OccupancyGrid::kUnknown;
      }
    }
  }
}

}  // namespace docent::localization
