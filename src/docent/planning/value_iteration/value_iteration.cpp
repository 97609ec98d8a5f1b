#include "docent/planning/value_iteration/value_iteration.h"

#include <algorithm>

#include "docent/base/check.h"
#include "docent/planning/value_iteration/tile_layout.h"

namespace docent::planning {
namespace {

std::uint64_t row_bit(CellIndex cell) { return std::uint64_t{1} << cell.row % kTileSide; }
std::uint64_t column_bit(CellIndex cell) { return std::uint64_t{1} << cell.column % kTileSide; }

int tiles_for(int cells) { return (cells + kTileSide - 1) / kTileSide; }

}  // namespace

ValueIteration::ValueIteration(const GridFrame& frame, InstructionSet set)
    : frame_{frame},
      kernels_{&tile_kernels(set)},
      tile_columns_{tiles_for(frame.columns)},
      tile_rows_{tiles_for(frame.rows)} {
  const std::size_t tiles = static_cast<std::size_t>(tile_columns_) * static_cast<std::size_t>(tile_rows_);
  costs_.assign(tiles * kTileCells, kClosed);
  values_.assign(tiles * kTileCells, kClosed);
  tiles_.resize(tiles);
  edges_.resize(tiles);
  to_tile_.assign(tiles, 0.0F);
  for (Edges& edges : edges_) {
    for (Edge& edge : edges.values) edge.fill(kClosed);
    for (Edge& edge : edges.costs) edge.fill(kClosed);
  }
  no_goals_.assign(kTileCells, kClosed);
}

/// -1 beyond the grid.
std::ptrdiff_t ValueIteration::neighbour(std::size_t tile, int columns, int rows) const {
  const int column = static_cast<int>(tile) % tile_columns_ + columns;
  const int row = static_cast<int>(tile) / tile_columns_ + rows;
  if (column < 0 || row < 0 || column >= tile_columns_ || row >= tile_rows_) return -1;
  return static_cast<std::ptrdiff_t>(row) * tile_columns_ + column;
}

/// Where the k-th cell of a side lies in its tile.
std::size_t ValueIteration::on_side(Side side, int k) {
  const int row = side == kBottom ? 0 : side == kTop ? kLastLine : k;
  const int column = side == kLeft ? 0 : side == kRight ? kLastLine : k;
  return static_cast<std::size_t>(row * kTileSide + column);
}

const float* ValueIteration::goals_of(std::size_t tile) const {
  const auto found = goals_.find(tile);
  return found == goals_.end() ? no_goals_.data() : found->second.data();
}

bool ValueIteration::is_goal(CellIndex cell) const {
  const float own = goals_of(tile_of(cell))[index(cell) % kTileCells];
  return own < kClosed && value(cell) == own;
}

void ValueIteration::queue_fall(std::size_t tile, float from) {
  if (!(from < tiles_[tile].falls_from)) return;
  tiles_[tile].falls_from = from;
  falls_.emplace(from + to_tile_[tile], static_cast<std::uint32_t>(tile));
}
void ValueIteration::queue_loss(std::size_t tile, float from, std::uint64_t rows) {
  tiles_[tile].lost_rows |= rows;
  if (!(from < tiles_[tile].lost_from)) return;
  tiles_[tile].lost_from = from;
  losses_.emplace(from, static_cast<std::uint32_t>(tile));
}
// What takes a tile from a queue clears what is out of date behind it, so that the top is always true.
void ValueIteration::settle_next() {
  const std::size_t tile = falls_.top().second;
  tiles_[tile].falls_from = kClosed;
  const auto is_stale = [this](const auto& entry) {
    return entry.first != tiles_[entry.second].falls_from + to_tile_[entry.second];
  };
  while (!falls_.empty() && is_stale(falls_.top())) falls_.pop();
  settle_tile(tile);
}

/// From now on those tiles come first from where a way to this cell can be cheapest; none: those with the least offer.
void ValueIteration::aim_at(std::optional<CellIndex> cell) {
  if (cell == aim_) return;
  aim_ = cell;
  falls_ = {};
  for (std::size_t tile = 0; tile < tiles_.size(); ++tile) {
    to_tile_[tile] = cell ? least_cost_to(*cell, tile) : 0.0F;
    queue_fall(tile, std::exchange(tiles_[tile].falls_from, kClosed));
  }
}

/// No way from the cell to any of the tile's is cheaper: over the cheapest floor, as the crow flies on a grid.
float ValueIteration::least_cost_to(CellIndex cell, std::size_t tile) const {
  // Less by what sums below farthest() may round away; and by more, so that of tiles that lie on ways of equal cost
  // those nearer to a goal come first.
  constexpr float kShare = 0.9F;
  const auto away = [](int at, int first) { return std::max({first - at, at - (first + kLastLine), 0}); };
  const int columns = away(cell.column, static_cast<int>(tile) % tile_columns_ * kTileSide);
  const int rows = away(cell.row, static_cast<int>(tile) / tile_columns_ * kTileSide);
  const auto aslant = static_cast<float>(std::min(columns, rows));
  const auto straight = static_cast<float>(std::max(columns, rows)) - aslant;
  return columns == 0 && rows == 0 ? 0.0F : kShare * least_cost_ * (straight + aslant * kDiagonalStep);
}
void ValueIteration::set_costs(std::span<const float> costs) {
  DOCENT_CHECK(costs.size() == frame_.size());
  std::vector<Change> changes;
  for (int row = 0; row < frame_.rows; ++row) {
    for (int column = 0; column < frame_.columns; ++column) {
      const float cost = costs[frame_.index({column, row})];
      if (cost != costs_[index({column, row})]) changes.push_back({{column, row}, cost});
    }
  }
  change_costs(changes);
}

void ValueIteration::change_costs(std::span<const Change> changes) {
  started_at_.reset();
  for (const Change& change : changes) {
    const std::size_t at = index(change.cell);
    const std::size_t tile = tile_of(change.cell);
    const float old = std::exchange(costs_[at], change.cost);
    least_cost_ = std::min(least_cost_, change.cost);
    const int row = change.cell.row % kTileSide;
    const int column = change.cell.column % kTileSide;
    auto& edges = edges_[tile].costs;
    if (row == 0) edges[kBottom][static_cast<std::size_t>(column)] = change.cost;
    if (row == kLastLine) edges[kTop][static_cast<std::size_t>(column)] = change.cost;
    if (column == 0) edges[kLeft][static_cast<std::size_t>(row)] = change.cost;
    if (column == kLastLine) edges[kRight][static_cast<std::size_t>(row)] = change.cost;

    const float here = value(change.cell);
    if (here == kClosed || change.cost == old) continue;
    for (const GridStep& step : kGridSteps) {
      const CellIndex beside{change.cell.column + step.column, change.cell.row + step.row};
      if (!frame_.holds(beside)) continue;
      const float held = value(beside);
      const float now = here + change.cost * step.length;
      if (now < held) {
        tiles_[tile_of(beside)].stirred.rows |= row_bit(beside);
        tiles_[tile_of(beside)].stirred.columns |= column_bit(beside);
        queue_fall(tile_of(beside), now);
      } else if (now > held && here + old * step.length <= held) {
        queue_loss(tile_of(beside), held, row_bit(beside));
      }
    }
  }
}

void ValueIteration::set_goals(std::span<const Goal> goals) {
  for (Tile& tile : tiles_) tile = {};
  falls_ = {};
  losses_ = {};
  started_at_ = relaxations_;
  goals_.clear();
  for (const Goal& goal : goals) {
    if (!frame_.holds(goal.cell)) continue;
    const std::size_t tile = tile_of(goal.cell);
    unblank(tile);
    auto& of_tile = goals_.try_emplace(tile, kTileCells, kClosed).first->second;
    float& own = of_tile[index(goal.cell) % kTileCells];
    own = std::min(own, goal.value);
    values_[index(goal.cell)] = own;
    tiles_[tile].stirred = {kAllLines, kAllLines};
    queue_fall(tile, goal.value);
  }
  for (const auto& [tile, of_tile] : goals_) copy_edges(tile);
}

bool ValueIteration::iterate(int most_visits) {
  if (is_settled()) return true;
  aim_at(std::nullopt);
  for (int i = 0; i < most_visits && !is_settled(); ++i) {
    if (!losses_.empty()) {
      reset_and_tell(losses_.top().second);
    } else {
      settle_next();
    }
  }
  if (is_settled() && started_at_) {
    const auto reached = std::count_if(tiles_.begin(), tiles_.end(), [](const Tile& tile) { return !tile.is_blank; });
    work_a_tile_ = (relaxations_ - *started_at_) / static_cast<std::uint64_t>(std::max<std::ptrdiff_t>(reached, 1));
    started_at_.reset();
  }
  return is_settled();
}

std::vector<CellIndex> ValueIteration::descend(CellIndex start) const {
  std::vector<CellIndex> way;
  if (!frame_.holds(start) || value(start) == kClosed) return way;
  CellIndex cell = start;
  while (!is_goal(cell)) {
    CellIndex next = cell;
    float least = kClosed;
    for (const GridStep& step : kGridSteps) {
      const CellIndex neighbour{cell.column + step.column, cell.row + step.row};
      if (!frame_.holds(neighbour)) continue;
      const float through = value(neighbour) + cost(neighbour) * step.length;
      if (through < least) {
        least = through;
        next = neighbour;
      }
    }
    // A value that has lost its ground holds no way, until it is reset.
    if (least > value(cell) || !(value(next) < value(cell))) return {};
    way.push_back(next);
    cell = next;
  }
  return way;
}

}  // namespace docent::planning
