#include "docent/simulator/traced/floor_plan.h"

#include <algorithm>
#include <cmath>

#include "docent/simulator/traced/outlines.h"

namespace docent::simulator {
namespace {

using Cells = std::vector<bool>;

Cells inverted(Cells cells) {
  cells.flip();
  return cells;
}

/// Cells whose centre is nearer than `reach` to that of a set cell.
Cells grown(const GridFrame& frame, const Cells& cells, double reach) {
  const std::vector<float> away = distance_transform(frame, cells);
  Cells result(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) result[i] = static_cast<double>(away[i]) < reach;
  return result;
}

/// Set cells that keep `reach` from all that are not set.
Cells shrunk(const GridFrame& frame, const Cells& cells, double reach) {
  return inverted(grown(frame, inverted(cells), reach));
}

/// The largest region of the set cells.
Cells largest_region(const GridFrame& frame, const Cells& cells) {
  const std::vector<int> labels = label_regions(frame, cells);
  std::vector<std::size_t> sizes(static_cast<std::size_t>(*std::max_element(labels.begin(), labels.end())) + 1, 0);
  for (const int label : labels) {
    if (label > 0) ++sizes[static_cast<std::size_t>(label)];
  }
  const auto best = static_cast<int>(std::max_element(sizes.begin(), sizes.end()) - sizes.begin());
  Cells result(cells.size(), false);
  for (std::size_t i = 0; i < cells.size(); ++i) result[i] = best > 0 && labels[i] == best;
  return result;
}

/// Everything but what can be reached from the frame's rim without crossing a set cell.
Cells without_holes(const GridFrame& frame, const Cells& cells) {
  const std::vector<int> labels = label_regions(frame, inverted(cells));
  Cells result(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) result[i] = labels[i] != labels[0];
  return result;
}

/// The map with a rim of two unknown cells: every outline closes, and cell 0 lies outside.
OccupancyGrid framed(const OccupancyGrid& map) {
  constexpr int kRim = 2;
  OccupancyGrid result;
  result.frame = map.frame;
  result.frame.columns += 2 * kRim;
  result.frame.rows += 2 * kRim;
  result.frame.origin = map.frame.origin - Point2{kRim * map.frame.resolution, kRim * map.frame.resolution};
  result.cells.assign(result.frame.size(), OccupancyGrid::kUnknown);
  for (int row = 0; row < map.frame.rows; ++row) {
    for (int column = 0; column < map.frame.columns; ++column) {
      result.cells[result.frame.index({column + kRim, row + kRim})] = map.cells[map.frame.index({column, row})];
    }
  }
  return result;
}

/// Free cells, and those of things smaller than `least` [m2].
Cells free_cells(const OccupancyGrid& map, double least) {
  Cells free(map.cells.size());
  for (std::size_t i = 0; i < free.size(); ++i) free[i] = map.cells[i] >= 0 && map.cells[i] < 20;
  const std::vector<int> things = label_regions(map.frame, inverted(free));
  std::vector<std::size_t> sizes(static_cast<std::size_t>(*std::max_element(things.begin(), things.end())) + 1, 0);
  for (const int thing : things) ++sizes[static_cast<std::size_t>(thing)];
  const double cell = map.frame.resolution * map.frame.resolution;
  for (std::size_t i = 0; i < free.size(); ++i) {
    if (static_cast<double>(sizes[static_cast<std::size_t>(things[i])]) * cell < least) free[i] = true;
  }
  return free;
}

Polygon outermost(const GridFrame& frame, const Cells& cells) {
  Polygon best;
  for (Polygon& outline : trace_outlines(frame, cells)) {
    if (best.empty() || signed_area(outline) > signed_area(best)) best = std::move(outline);
  }
  return best;
}

}  // namespace

std::vector<int> label_regions(const GridFrame& frame, const std::vector<bool>& cells) {
  std::vector<int> labels(cells.size(), 0);
  std::vector<CellIndex> stack;
  int label = 0;
  for (int row = 0; row < frame.rows; ++row) {
    for (int column = 0; column < frame.columns; ++column) {
      const CellIndex seed{column, row};
      if (!cells[frame.index(seed)] || labels[frame.index(seed)] != 0) continue;
      labels[frame.index(seed)] = ++label;
      stack.push_back(seed);
      while (!stack.empty()) {
        const CellIndex cell = stack.back();
        stack.pop_back();
        for (const CellIndex next : {CellIndex{cell.column + 1, cell.row}, CellIndex{cell.column - 1, cell.row},
                                     CellIndex{cell.column, cell.row + 1}, CellIndex{cell.column, cell.row - 1}}) {
          if (!frame.holds(next) || !cells[frame.index(next)] || labels[frame.index(next)] != 0) continue;
          labels[frame.index(next)] = label;
          stack.push_back(next);
        }
      }
    }
  }
  return labels;
}

Result<FloorPlan> trace_floor(const OccupancyGrid& bare, const FloorPlanParams& params) {
  const OccupancyGrid map = framed(bare);
  const GridFrame& frame = map.frame;
  const double half = 0.5 * params.passage;
  const Cells free = free_cells(map, params.least_island);
  // Morphological opening by a disc of half a passage, of the part that hangs together.
  const Cells core = largest_region(frame, shrunk(frame, free, half));
  const auto count = static_cast<double>(std::count(core.begin(), core.end(), true));
  if (count * frame.resolution * frame.resolution < params.least_floor) {
    return fail("the map has no open floor of " + std::to_string(std::lround(params.least_floor)) +
                " m2 that hangs together by passages of " + std::to_string(std::lround(100.0 * params.passage)) +
                " cm");
  }
  // A little more than the disc reaches, so that rooms keep their corners.
  Cells floor = grown(frame, core, 1.45 * half);
  for (std::size_t i = 0; i < floor.size(); ++i) floor[i] = floor[i] && free[i];
  Cells solid = inverted(floor);
  join_corners(frame, solid);
  floor = largest_region(frame, inverted(solid));
  solid = inverted(floor);
  join_corners(frame, solid);

  FloorPlan plan;
  plan.floor = simplified(outermost(frame, inverted(solid)), params.tolerance);
  plan.frame = frame;
  plan.building = without_holes(frame, inverted(solid));
  Cells standing = plan.building;
  for (std::size_t i = 0; i < standing.size(); ++i) standing[i] = standing[i] && solid[i];
  for (Polygon& outline : trace_outlines(frame, standing)) {
    if (signed_area(outline) < params.least_island) continue;
    plan.islands.push_back(simplified(outline, params.tolerance));
  }
  return plan;
}

Polygon trace_area(const FloorPlan& plan, std::span<const Polygon> kept_off, double rim, double tolerance) {
  const GridFrame& frame = plan.frame;
  Cells inside = plan.building;
  for (std::size_t i = 0; i < inside.size(); ++i) {
    const auto columns = static_cast<std::size_t>(frame.columns);
    const Point2 centre = frame.centre({static_cast<int>(i % columns), static_cast<int>(i / columns)});
    inside[i] = inside[i] && std::none_of(kept_off.begin(), kept_off.end(),
                                          [&](const Polygon& polygon) { return contains(polygon, centre); });
  }
  constexpr double kBay = 0.2;  // [m] half the width of bays that are not worth their corners
  const Cells open = largest_region(frame, shrunk(frame, inside, rim + kBay));
  Cells outside = inverted(grown(frame, open, kBay));
  join_corners(frame, outside);
  return simplified(outermost(frame, inverted(outside)), tolerance);
}

}  // namespace docent::simulator
