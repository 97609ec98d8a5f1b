#include "docent/apps/laboratory/score_map/reachable_floor.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "docent/grid/occupancy_grid.h"

namespace docent::apps::score_map_command {
namespace {

constexpr double kRobot = 0.365;  // [m], with its margin
constexpr double kReach = 10.0;   // [m] that lasers look
constexpr int kRays = 720;
constexpr int kSparse = 4;  // cells from one place to look from to the next

struct Grid {
  GridFrame frame;
  std::vector<bool> is_floor;   ///< inside, and clear of all that stands or lies on it
  std::vector<bool> hides;      ///< a laser ends here
  std::vector<bool> is_closed;  ///< something stands here, were it thinner than a cell, or it is outside
};

Grid grid_of(const simulator::World& world, double step) {
  Point2 low = world.floor.front();
  Point2 high = low;
  for (const Point2 p : world.floor) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  Grid grid;
  grid.frame = {static_cast<int>((high.x - low.x) / step) + 1, static_cast<int>((high.y - low.y) / step) + 1, step,
                low};
  grid.is_floor.assign(grid.frame.size(), false);
  grid.hides.assign(grid.frame.size(), false);
  for (int row = 0; row < grid.frame.rows; ++row) {
    for (int column = 0; column < grid.frame.columns; ++column) {
      const Point2 at = grid.frame.centre({column, row});
      const std::size_t i = grid.frame.index({column, row});
      grid.is_floor[i] = contains(world.floor, at);
      for (const simulator::Solid& solid : world.solids) {
        if (!contains(solid.polygon, at)) continue;
        grid.is_floor[i] = false;
        grid.hides[i] = grid.hides[i] || is_seen_by_laser(solid);
      }
    }
  }
  grid.is_closed = grid.is_floor;
  grid.is_closed.flip();
  // Walls and doors thinner than a cell, too.
  for (const simulator::Solid& solid : world.solids) {
    for (const Segment& side : sides(solid.polygon)) {
      const double length = distance(side.a, side.b);
      for (double d = 0.0; d < length; d += 0.5 * step) {
        const CellIndex cell = grid.frame.cell_at(side.a + (d / length) * (side.b - side.a));
        if (!grid.frame.holds(cell)) continue;
        grid.is_closed[grid.frame.index(cell)] = true;
        if (is_seen_by_laser(solid)) grid.hides[grid.frame.index(cell)] = true;
      }
    }
  }
  return grid;
}

/// The largest piece in one of what is true.
std::vector<CellIndex> largest_piece(const GridFrame& frame, std::vector<bool> is_open) {
  std::vector<CellIndex> largest;
  for (int row = 0; row < frame.rows; ++row) {
    for (int column = 0; column < frame.columns; ++column) {
      if (!is_open[frame.index({column, row})]) continue;
      std::vector<CellIndex> piece{{column, row}};
      is_open[frame.index({column, row})] = false;
      for (std::size_t i = 0; i < piece.size(); ++i) {
        const CellIndex cell = piece[i];
        for (const CellIndex next : {CellIndex{cell.column + 1, cell.row}, CellIndex{cell.column - 1, cell.row},
                                     CellIndex{cell.column, cell.row + 1}, CellIndex{cell.column, cell.row - 1}}) {
          if (!frame.holds(next) || !is_open[frame.index(next)]) continue;
          is_open[frame.index(next)] = false;
          piece.push_back(next);
        }
      }
      if (piece.size() > largest.size()) largest = std::move(piece);
    }
  }
  return largest;
}

}  // namespace

ReachableFloor reachable_floor(const simulator::World& world) {
  ReachableFloor result;
  const Grid grid = grid_of(world, result.step);
  const GridFrame& frame = grid.frame;
  const auto clearances = distance_transform(frame, grid.is_closed);
  std::vector<bool> is_open(frame.size());
  for (int row = 0; row < frame.rows; ++row) {
    for (int column = 0; column < frame.columns; ++column) {
      const std::size_t i = frame.index({column, row});
      is_open[i] =
          static_cast<double>(clearances[i]) >= kRobot && contains(world.operating_area, frame.centre({column, row}));
    }
  }
  std::vector<bool> is_seen(frame.size(), false);
  for (const CellIndex from : largest_piece(frame, std::move(is_open))) {
    if (from.column % kSparse != 0 || from.row % kSparse != 0) continue;
    const Point2 eye = frame.centre(from);
    for (int ray = 0; ray < kRays; ++ray) {
      const Point2 along = unit(Angle::radians(2.0 * std::numbers::pi * ray / kRays));
      for (double d = 0.0; d < kReach; d += 0.7 * frame.resolution) {
        const CellIndex cell = frame.cell_at(eye + d * along);
        if (!frame.holds(cell) || grid.hides[frame.index(cell)]) break;
        is_seen[frame.index(cell)] = true;
      }
    }
  }
  for (int row = 0; row < frame.rows; ++row) {
    for (int column = 0; column < frame.columns; ++column) {
      const std::size_t i = frame.index({column, row});
      if (is_seen[i] && grid.is_floor[i]) result.cells.push_back(frame.centre({column, row}));
    }
  }
  return result;
}

}  // namespace docent::apps::score_map_command
