#include <algorithm>
#include <utility>

#include "docent/planning/value_iteration/tile_layout.h"
#include "docent/planning/value_iteration/value_iteration.h"

// How values that have lost their ground are repaired, only as far as the value of one cell needs it.

namespace docent::planning {

bool ValueIteration::settle(CellIndex cell, int most_visits) {
  // A value is final when nothing that falls can lower it and when a chain of cells, each less than the one before and
  // holding it up, leads from it to where all values are sound. Values that have lost their ground elsewhere do not
  // matter: they are too small, so they would have been gone to. Where the chain breaks, it is repaired.
  aim_at(std::nullopt);
  std::vector<CellIndex> chain{cell};
  Repair repair{cell, std::vector<bool>(tiles_.size()), relaxations_};
  for (;;) {
    while (!falls_.empty() && (falls_.top().first < value(cell) || value(cell) > farthest())) {
      if (most_visits-- <= 0) return false;
      if (!is_worth_it(repair)) start_over(repair);
      settle_next();
      chain = {cell};
    }
    const CellIndex last = chain.back();
    if (losses_.empty() || value(last) == kClosed || value(last) < losses_.top().first || is_goal(last)) return true;
    if (const auto next = support_of(last)) {
      chain.push_back(*next);
      continue;
    }
    if (most_visits <= 0) return false;
    repair.is_straight = knows_the_way(cell);
    repair.most = worth_repairing(repair);
    widen(repair, chain);
    most_visits -= reset_all(repair);
    if (!is_worth_it(repair)) start_over(repair);
    chain = {cell};
  }
}

bool ValueIteration::is_worth_it(const Repair& repair) const {
  return losses_.empty() || relaxations_ - repair.began < repair.most;
}

/// Takes in the tiles near a broken chain. The farther round it the more often it broke before: tiles that are reset
/// take what falls from those beside them, and if that has lost its ground as well, they must be reset once more.
void ValueIteration::widen(Repair& repair, std::span<const CellIndex> chain) const {
  const auto tile_at = [](int at, int count) { return std::clamp(at, 0, count - 1) / kTileSide; };
  for (const CellIndex cell : chain) {
    const int right = tile_at(cell.column + repair.reach, frame_.columns);
    const int top = tile_at(cell.row + repair.reach, frame_.rows);
    for (int row = tile_at(cell.row - repair.reach, frame_.rows); row <= top; ++row)
      for (int column = tile_at(cell.column - repair.reach, frame_.columns); column <= right; ++column)
        repair.takes_in[static_cast<std::size_t>(row * tile_columns_ + column)] = true;
  }
  if (++repair.rounds % 2 == 0) repair.reach = std::min(2 * repair.reach, 64 * kTileSide);
}

/// Resets what has lost its ground in the tiles of a repair, the least values first, for as long as it is worth it.
/// @returns how many tiles were visited
int ValueIteration::reset_all(const Repair& repair) {
  Queue lost;
  const auto enter = [&](std::size_t tile) {
    if (repair.takes_in[tile] && tiles_[tile].lost_from < kClosed)
      lost.emplace(tiles_[tile].lost_from, static_cast<std::uint32_t>(tile));
  };
  for (std::size_t tile = 0; tile < tiles_.size(); ++tile) enter(tile);
  int visits = 0;
  while (!lost.empty() && is_worth_it(repair)) {
    const auto [from, tile] = lost.top();
    lost.pop();
    if (from != tiles_[tile].lost_from) continue;
    reset_and_tell(tile);
    ++visits;
    for (const int rows : {-1, 0, 1}) {
      for (const int columns : {-1, 0, 1}) {
        const std::ptrdiff_t beside = neighbour(tile, columns, rows);
        if (beside >= 0) enter(static_cast<std::size_t>(beside));
      }
    }
  }
  return visits;
}

/// The neighbour that holds up a cell's value; none if it has lost its ground.
std::optional<CellIndex> ValueIteration::support_of(CellIndex cell) const {
  const std::size_t at = index(cell);
  const float held = values_[at];  // a value that is held is in no blank tile
  const int row = cell.row % kTileSide;
  const int column = cell.column % kTileSide;
  const bool is_inside = row > 0 && column > 0 && row < kLastLine && column < kLastLine;
  std::optional<CellIndex> best;
  float least = kClosed;
  for (const GridStep& step : kGridSteps) {
    const CellIndex neighbour{cell.column + step.column, cell.row + step.row};
    if (!is_inside && !frame_.holds(neighbour)) continue;
    const std::size_t beside =
        is_inside ? at + static_cast<std::size_t>(step.row * kTileSide + step.column) : index(neighbour);
    const float there = is_inside ? values_[beside] : value(neighbour);
    const float through = there + costs_[beside] * step.length;
    if (through < least && there < held) {
      least = through;
      best = neighbour;
    }
  }
  return least <= held ? best : std::nullopt;
}

/// Whether the cheapest floor straight to a goal says something about the way there: not so in a maze, where looking
/// that way first means to look often.
bool ValueIteration::knows_the_way(CellIndex cell) const {
  float least = kClosed;
  for (const auto& [tile, of_tile] : goals_) {
    const float there = *std::min_element(of_tile.begin(), of_tile.end());
    least = std::min(least, least_cost_to(cell, tile) + there);
  }
  return least > 0.7F * value(cell);
}

/// Offers that may go into repairing, so that with a start over behind it the work stays below that of a start from
/// nothing: half of what a start over spares, the tiles that keep their values and those well beyond the robot; of
/// those that lie off its way a quarter.
std::uint64_t ValueIteration::worth_repairing(const Repair& repair) const {
  constexpr std::uint64_t kOneReset = 2;              // [tiles' work] by which the last one may exceed it
  const float beyond = 1.15F * value(repair.wanted);  // too small perhaps, never too large
  const float sound_below = losses_.top().first;
  std::uint64_t quarters = 0;  // of the work of a tile
  for (std::size_t tile = 0; tile < tiles_.size(); ++tile) {
    const Tile& here = tiles_[tile];
    if (here.is_blank) continue;
    if (here.most < sound_below || here.least > beyond) {
      quarters += 2;
    } else if (repair.is_straight && here.least + least_cost_to(repair.wanted, tile) > beyond) {
      quarters += 1;
    }
  }
  const std::uint64_t most = quarters * work_a_tile_ / 4;
  return most - std::min(most, kOneReset * work_a_tile_);
}

/// Share of the tiles that would keep their values in a start over above `sound`.
double ValueIteration::sound_share(float sound) const {
  std::ptrdiff_t known = 0;
  std::ptrdiff_t kept = 0;
  for (const Tile& tile : tiles_) {
    known += tile.is_blank ? 0 : 1;
    kept += !tile.is_blank && tile.most < sound ? 1 : 0;
  }
  return known == 0 ? 0.0 : static_cast<double>(kept) / static_cast<double>(known);
}

/// To go on from next to nothing costs more than to begin with nothing, where no work is lost.
void ValueIteration::start_over(const Repair& repair) {
  const float sound = losses_.top().first;
  if (repair.is_straight) aim_at(repair.wanted);
  start_over_above(relaxations_ == repair.began && sound_share(sound) < 0.15 ? 0.0F : sound);
}

/// Forgets all tiles but those whose values are all less than `sound`.
void ValueIteration::start_over_above(float sound) {
  losses_ = {};
  falls_ = {};
  for (std::size_t tile = 0; tile < tiles_.size(); ++tile) {
    const float* const values = values_.data() + tile * kTileCells;
    const auto is_sound = [sound](float value) { return value < sound || value == kClosed; };
    if (tiles_[tile].is_blank || !std::all_of(values, values + kTileCells, is_sound)) tiles_[tile] = {};
    tiles_[tile].lost_from = kClosed;
    tiles_[tile].lost_rows = 0;
    queue_fall(tile, std::exchange(tiles_[tile].falls_from, kClosed));
  }
  const auto borders_on_blank = [this](std::size_t tile) {
    for (const int rows : {-1, 0, 1}) {
      for (const int columns : {-1, 0, 1}) {
        const std::ptrdiff_t beside = neighbour(tile, columns, rows);
        if (beside >= 0 && tiles_[static_cast<std::size_t>(beside)].is_blank) return true;
      }
    }
    return false;
  };
  for (std::size_t tile = 0; tile < tiles_.size(); ++tile)
    if (!tiles_[tile].is_blank && borders_on_blank(tile)) offer_to_neighbours(tile);
  for (const auto& [tile, of_tile] : goals_) {
    if (!tiles_[tile].is_blank) continue;
    unblank(tile);
    std::copy(of_tile.begin(), of_tile.end(), values_.begin() + static_cast<std::ptrdiff_t>(tile * kTileCells));
    copy_edges(tile);
    tiles_[tile].stirred = {kAllLines, kAllLines};
    queue_fall(tile, *std::min_element(of_tile.begin(), of_tile.end()));
  }
}

}  // namespace docent::planning
