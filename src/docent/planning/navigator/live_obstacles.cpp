#include "docent/planning/navigator/live_obstacles.h"

#include <algorithm>
#include <utility>

#include "docent/mapping/occupancy/live_map.h"

namespace docent::planning {
namespace {

constexpr std::int8_t kBlocked = 65;  ///< as OccupancyGrid::is_occupied

}  // namespace

LiveObstacles::LiveObstacles(OccupancyGrid map)
    : map_{std::move(map)}, standing_(map_.frame.size()), settled_(map_.frame.size()) {}

void LiveObstacles::take_map(Time stamp, std::span<const std::int8_t> cells) {
  if (cells.size() != standing_.size()) return;
  base_ = stamp;
  number_ = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) take(i, cells[i]);
  note_change({0, 0}, {map_.frame.columns - 1, map_.frame.rows - 1});
}

void LiveObstacles::take_patch(const LivePatch& patch) {
  if (patch.base != base_ || patch.number != number_ + 1) return;
  if (patch.cells.size() != static_cast<std::size_t>(patch.columns) * patch.rows) return;
  number_ = patch.number;
  if (patch.cells.empty()) return;
  std::size_t k = 0;
  for (std::uint32_t row = 0; row < patch.rows; ++row) {
    for (std::uint32_t column = 0; column < patch.columns; ++column, ++k) {
      const CellIndex cell{patch.low.column + static_cast<int>(column), patch.low.row + static_cast<int>(row)};
      if (map_.frame.holds(cell)) take(map_.frame.index(cell), patch.cells[k]);
    }
  }
  note_change(patch.low, {patch.low.column + static_cast<int>(patch.columns) - 1,
                          patch.low.row + static_cast<int>(patch.rows) - 1});
}

bool LiveObstacles::stands_within(Point2 in_map, double radius) const {
  const CellIndex low = map_.frame.cell_at(in_map - Point2{radius, radius});
  const CellIndex high = map_.frame.cell_at(in_map + Point2{radius, radius});
  for (int row = low.row; row <= high.row; ++row) {
    for (int column = low.column; column <= high.column; ++column) {
      const CellIndex cell{column, row};
      if (map_.frame.holds(cell) && standing_[map_.frame.index(cell)] &&
          distance(map_.frame.centre(cell), in_map) <= radius)
        return true;
    }
  }
  return false;
}

std::optional<CellBox> LiveObstacles::take_changes() { return std::exchange(changed_, std::nullopt); }

void LiveObstacles::take(std::size_t index, std::int8_t live) {
  standing_[index] = live >= kBlocked && map_.cells[index] < kBlocked;
  settled_[index] = standing_[index] && live >= mapping::LiveMap::kSettled;
}

void LiveObstacles::note_change(CellIndex low, CellIndex high) {
  low = {std::max(low.column, 0), std::max(low.row, 0)};
  high = {std::min(high.column, map_.frame.columns - 1), std::min(high.row, map_.frame.rows - 1)};
  if (changed_) {
    low = {std::min(low.column, changed_->low.column), std::min(low.row, changed_->low.row)};
    high = {std::max(high.column, changed_->high.column), std::max(high.row, changed_->high.row)};
  }
  changed_ = CellBox{low, high};
}

}  // namespace docent::planning
