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
  kinds_.resize(frame_.size());
  std::vector<bool> occupied(frame_.size());
  std::vector<bool> blocked(frame_.size());
  for (int row = 0; row < frame_.rows; ++row) {
    for (int column = 0; column < frame_.columns; ++column) {
      const CellIndex cell{column, row};
      const std::size_t i = frame_.index(cell);
      kinds_[i] = map.is_occupied(cell) ? Kind::occupied : map.is_free(cell) ? Kind::free : Kind::unknown;
      occupied[i] = kinds_[i] == Kind::occupied;
      // The border counts as blocked, so that no leap leaves the map.
      blocked[i] =
          kinds_[i] != Kind::free || row == 0 || column == 0 || row + 1 == frame_.rows || column + 1 == frame_.columns;
    }
  }
  clearance_ = distance_transform(frame_, occupied);
  leap_ = distance_transform(frame_, blocked);
  // From any point of this cell to any point of the nearest blocked one: half a diagonal less at both ends.
  const auto diagonal = static_cast<float>(frame_.resolution * std::numbers::sqrt2);
  for (float& leap : leap_) leap -= diagonal;
}

float RayCaster::clearance(Point2 in_map) const {
  const CellIndex cell = frame_.cell_at(in_map);
  return frame_.holds(cell) ? clearance_[frame_.index(cell)] : std::numeric_limits<float>::infinity();
}

std::optional<double> RayCaster::cast(Point2 from, Point2 direction, double max_range, double unknown_allowance) const {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const double resolution = frame_.resolution;
  const double cells_a_metre = 1.0 / resolution;
  const Point2 start = from - frame_.origin;
  CellIndex cell = frame_.cell_at(from);
  double way = 0.0;
  double unknown = 0.0;
  while (way < max_range) {
    if (!frame_.holds(cell)) return std::nullopt;
    const std::size_t i = frame_.index(cell);
    if (const double leap = static_cast<double>(leap_[i]); leap > resolution) {  // free, then
      way += leap;
      cell = {floor_of((start.x + way * direction.x) * cells_a_metre),
              floor_of((start.y + way * direction.y) * cells_a_metre)};
      continue;
    }
    const Kind kind = kinds_[i];
    if (kind == Kind::occupied) return way;
    const double to_column = direction.x > 0.0   ? ((cell.column + 1) * resolution - start.x) / direction.x
                             : direction.x < 0.0 ? (cell.column * resolution - start.x) / direction.x
                                                 : kNever;
    const double to_row = direction.y > 0.0   ? ((cell.row + 1) * resolution - start.y) / direction.y
                          : direction.y < 0.0 ? (cell.row * resolution - start.y) / direction.y
                                              : kNever;
    const double next = std::max(way, std::min(to_column, to_row));
    if (kind == Kind::unknown) {
      unknown += std::min(next, max_range) - way;
      if (unknown > unknown_allowance) return std::nullopt;
    }
    way = next;
    if (to_column < to_row) {
      cell.column += direction.x > 0.0 ? 1 : -1;
    } else {
      cell.row += direction.y > 0.0 ? 1 : -1;
    }
  }
  return max_range;
}

}  // namespace docent::sensor_models
