#include "docent/mapping/occupancy/live_map.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace docent {

Result<void> LiveMapParams::validate() const {
  if (coarsening < 1 || coarsening > 20) return fail("coarsening must be in 1..20");
  if (!(reach > 0.0)) return fail("reach must be > 0");
  if (!(static_margin >= 0.0)) return fail("static_margin must be >= 0");
  if (hits_to_block < 1 || hits_to_block > 4) return fail("hits_to_block must be in 1..4");
  if (!(forget > 0.0)) return fail("forget must be > 0");
  if (!(settle >= 0.0)) return fail("settle must be >= 0");
  if (!(forget_settled >= forget)) return fail("forget_settled must be >= forget");
  if (!(period > 0.0)) return fail("period must be > 0");
  return {};
}

LiveMap::LiveMap(const OccupancyGrid& static_map, LiveMapParams params)
    : params_{params}, static_{coarsened(static_map, params.coarsening)} {
  std::vector<bool> solid(static_map.frame.size());
  for (std::size_t i = 0; i < solid.size(); ++i) solid[i] = static_map.cells[i] < 0 || static_map.cells[i] >= 65;
  const auto distances = distance_transform(static_map.frame, solid);
  const GridFrame& grid = static_.frame;
  near_static_.assign(grid.size(), true);
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      const CellIndex fine = static_map.frame.cell_at(grid.centre({column, row}));
      if (!static_map.frame.holds(fine)) continue;
      near_static_[grid.index({column, row})] =
          static_cast<double>(distances[static_map.frame.index(fine)]) <= params_.static_margin;
    }
  }
  history_.assign(grid.size(), 0);
  seen_.assign(grid.size(), Time{});
  blocked_since_.assign(grid.size(), Time{});
  settled_.assign(grid.size(), false);
  look_of_.assign(grid.size(), 0);
}

bool LiveMap::is_blocked(std::size_t index) const {
  const unsigned last_four = history_[index] & 0x0FU;
  return last_four != 0 && std::popcount(last_four) >= params_.hits_to_block;
}

std::int8_t LiveMap::cell(std::size_t index) const {
  if (!is_blocked(index)) return static_.cells[index];
  return std::max(static_.cells[index], is_settled(index) ? kSettled : kPassing);
}

void LiveMap::mark(CellIndex cell, bool hit, Time now) {
  if (!static_.frame.holds(cell)) return;
  const std::size_t index = static_.frame.index(cell);
  const bool was_blocked = is_blocked(index);
  const bool was_settled = was_blocked && settled_[index];
  if (look_of_[index] == look_) {
    // Hit and passed in one look: something stands in a part of the cell.
    history_[index] = static_cast<std::uint8_t>(history_[index] | (hit ? 1U : 0U));
  } else {
    look_of_[index] = look_;
    history_[index] = static_cast<std::uint8_t>(static_cast<unsigned>(history_[index]) << 1U | (hit ? 1U : 0U));
  }
  seen_[index] = now;
  if (!was_blocked && is_blocked(index)) blocked_since_[index] = now;
  settled_[index] = is_blocked(index) && to_seconds(now - blocked_since_[index]) >= params_.settle;
  if (was_blocked != is_blocked(index) || was_settled != settled_[index]) {
    if (!changes_) changes_ = Rectangle{cell, cell};
    changes_->low = {std::min(changes_->low.column, cell.column), std::min(changes_->low.row, cell.row)};
    changes_->high = {std::max(changes_->high.column, cell.column), std::max(changes_->high.row, cell.row)};
  }
}

void LiveMap::look(Point2 sensor, std::span<const Point2> endpoints, Time now) {
  ++look_;
  const double step = 0.5 * static_.frame.resolution;
  for (const Point2& endpoint : endpoints) {
    const double range = distance(sensor, endpoint);
    const double clear_to = std::min(range, params_.reach) - static_.frame.resolution;
    const Point2 along = range > 0.0 ? (1.0 / range) * (endpoint - sensor) : Point2{};
    for (double d = 0.0; d < clear_to; d += step) {
      const CellIndex cell = static_.frame.cell_at(sensor + d * along);
      if (!static_.frame.holds(cell)) continue;
      // That a second ray passes says nothing more.
      const std::size_t index = static_.frame.index(cell);
      if (history_[index] != 0 && look_of_[index] != look_) mark(cell, false, now);
    }
    if (range > params_.reach) continue;
    const CellIndex cell = static_.frame.cell_at(endpoint);
    if (static_.frame.holds(cell) && !near_static_[static_.frame.index(cell)]) mark(cell, true, now);
  }
}

void LiveMap::forget(Time now) {
  ++look_;
  for (int row = 0; row < static_.frame.rows; ++row) {
    for (int column = 0; column < static_.frame.columns; ++column) {
      const std::size_t index = static_.frame.index({column, row});
      if (history_[index] == 0) continue;
      const double memory = is_settled(index) ? params_.forget_settled : params_.forget;
      if (to_seconds(now - seen_[index]) < memory) continue;
      const Time seen = seen_[index];
      while (history_[index] != 0) {
        mark({column, row}, false, seen);
        ++look_;
      }
    }
  }
}

std::vector<bool> LiveMap::obstacles() const {
  std::vector<bool> result(static_.frame.size());
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = is_blocked(i);
  return result;
}

std::optional<LiveMap::Rectangle> LiveMap::take_changes() {
  const auto changes = changes_;
  changes_.reset();
  return changes;
}

}  // namespace docent
