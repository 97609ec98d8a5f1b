#include "docent/sensor_models/ray_caster.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace docent::sensor_models {
namespace {

/// Without a call into the library.
int floor_of(double value) {
  const int whole = static_cast<int>(value);
  return whole - (value < static_cast<double>(whole) ? 1 : 0);
}

}  // namespace

OccupancyGrid peeled(const OccupancyGrid& map, double depth) {
  const GridFrame& frame = map.frame;
  OccupancyGrid result = map;
  if (depth < 0.5 * frame.resolution) return result;
  std::vector<bool> is_free(frame.size());
  std::vector<bool> not_occupied(frame.size());
  for (std::size_t i = 0; i < frame.size(); ++i) {
    is_free[i] = map.cells[i] >= 0 && map.cells[i] < 20;
    not_occupied[i] = map.cells[i] < 65;
  }
  const std::vector<float> to_free = distance_transform(frame, is_free);
  const std::vector<float> inside = distance_transform(frame, not_occupied);  // how deep in the wall
  const auto is_ridge = [&](CellIndex cell) {
    const float here = inside[frame.index(cell)];
    for (int row = -1; row <= 1; ++row)
      for (int column = -1; column <= 1; ++column) {
        const CellIndex near{cell.column + column, cell.row + row};
        if (frame.holds(near) && inside[frame.index(near)] > here) return false;
      }
    return true;
  };
  // The outline lies half a cell before the first middle.
  const auto least = static_cast<float>(depth + 0.5 * frame.resolution);
  for (int row = 0; row < frame.rows; ++row)
    for (int column = 0; column < frame.columns; ++column) {
      const CellIndex cell{column, row};
      if (map.is_occupied(cell) && to_free[frame.index(cell)] < least && !is_ridge(cell))
        result.cells[frame.index(cell)] = OccupancyGrid::kFree;
    }
  return result;
}

RayCaster::RayCaster(const OccupancyGrid& map) : frame_{map.frame} {
  std::vector<bool> occupied(frame_.size());
  std::vector<bool> blocked(frame_.size());
  for (int row = 0; row < frame_.rows; ++row) {
    for (int column = 0; column < frame_.columns; ++column) {
      const CellIndex cell{column, row};
      const std::size_t i = frame_.index(cell);
      occupied[i] = map.is_occupied(cell);
      // The border counts as blocked, so that no leap leaves the map.
      blocked[i] =
          !map.is_free(cell) || row == 0 || column == 0 || row + 1 == frame_.rows || column + 1 == frame_.columns;
    }
  }
  clearance_ = distance_transform(frame_, occupied);

  const std::vector<float> to_blocked = distance_transform(frame_, blocked);
  const auto blocks_of = [](int cells) { return (static_cast<std::size_t>(cells) + kBlock - 1) / kBlock; };
  blocks_ = blocks_of(frame_.columns);
  steps_.assign(blocks_ * blocks_of(frame_.rows) * kBlock * kBlock, kUnknown);
  for (int row = 0; row < frame_.rows; ++row) {
    for (int column = 0; column < frame_.columns; ++column) {
      const CellIndex cell{column, row};
      std::uint8_t& step = steps_[place_of(cell)];
      if (map.is_occupied(cell)) {
        step = kOccupied;
      } else if (map.is_free(cell)) {
        // From any point of this cell to any point of the nearest blocked one: half a diagonal less at both ends.
        const double cells =
            static_cast<double>(to_blocked[frame_.index(cell)]) / frame_.resolution - std::numbers::sqrt2;
        // Less than a cell is not worth a leap; a hair less, for all this is rounded.
        const double halves = cells > 1.0 ? std::floor(2.0 * cells - 1e-3) : 0.0;
        step = static_cast<std::uint8_t>(std::min(kFree + halves, 255.0));
      }
    }
  }
}

float RayCaster::clearance(Point2 in_map) const {
  const CellIndex cell = frame_.cell_at(in_map);
  return frame_.holds(cell) ? clearance_[frame_.index(cell)] : std::numeric_limits<float>::infinity();
}

std::optional<double> RayCaster::cast(Point2 from, Point2 direction, double max_range, double unknown_allowance) const {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const double resolution = frame_.resolution;
  const double cells_a_metre = 1.0 / resolution;
  const double half_cell = 0.5 * resolution;
  const Point2 start = from - frame_.origin;
  const int next_column = direction.x > 0.0 ? 1 : 0;  // the far edge of a cell, seen along the ray
  const int next_row = direction.y > 0.0 ? 1 : 0;
  const auto to_column = [&](int column) {
    return direction.x == 0.0 ? kNever : ((column + next_column) * resolution - start.x) / direction.x;
  };
  const auto to_row = [&](int row) {
    return direction.y == 0.0 ? kNever : ((row + next_row) * resolution - start.y) / direction.y;
  };
  CellIndex cell = frame_.cell_at(from);
  double way = 0.0;
  double unknown = 0.0;
  while (way < max_range) {
    if (!frame_.holds(cell)) return std::nullopt;
    std::uint8_t step = steps_[place_of(cell)];
    if (step > kFree) {
      way += (step - kFree) * half_cell;
      cell = {floor_of((start.x + way * direction.x) * cells_a_metre),
              floor_of((start.y + way * direction.y) * cells_a_metre)};
      continue;
    }
    // From cell to cell, until there is something to leap over.
    double column_end = to_column(cell.column);
    double row_end = to_row(cell.row);
    while (step <= kFree) {
      if (step == kOccupied) return way;
      const double next = std::max(way, std::min(column_end, row_end));
      if (step == kUnknown) {
        unknown += std::min(next, max_range) - way;
        if (unknown > unknown_allowance) return std::nullopt;
      }
      way = next;
      if (column_end < row_end) {
        cell.column += 2 * next_column - 1;
        column_end = to_column(cell.column);
      } else {
        cell.row += 2 * next_row - 1;
        row_end = to_row(cell.row);
      }
      if (!(way < max_range)) return max_range;
      if (!frame_.holds(cell)) return std::nullopt;
      step = steps_[place_of(cell)];
    }
  }
  return max_range;
}

}  // namespace docent::sensor_models
