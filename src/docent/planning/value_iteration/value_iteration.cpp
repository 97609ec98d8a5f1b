#include "docent/planning/value_iteration/value_iteration.h"

#include <algorithm>
#include <cmath>

#include "docent/base/check.h"

namespace docent {
namespace {

struct Step {
  int column;
  int row;
  float length;
};
constexpr std::array<Step, 8> kSteps{{{1, 0, 1.0F},
                                      {0, 1, 1.0F},
                                      {-1, 0, 1.0F},
                                      {0, -1, 1.0F},
                                      {1, 1, kDiagonalStep},
                                      {-1, 1, kDiagonalStep},
                                      {-1, -1, kDiagonalStep},
                                      {1, -1, kDiagonalStep}}};

constexpr std::uint64_t kOffersALine =
    std::uint64_t{3} * kTileSide;  ///< in a sweep each cell looks at three neighbours
constexpr std::uint64_t kOffersALineReset = std::uint64_t{8} * kTileSide;
constexpr std::uint64_t kAll = ~std::uint64_t{0} >> (64 - kTileSide);  ///< all lines of a tile

constexpr int kLast = kTileSide - 1;
constexpr std::array<std::pair<int, int>, 4> kBeyond{{{0, -1}, {0, 1}, {-1, 0}, {1, 0}}};  ///< the tile beyond a side

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

std::size_t ValueIteration::tile_of(CellIndex cell) const {
  return static_cast<std::size_t>(cell.row / kTileSide) * static_cast<std::size_t>(tile_columns_) +
         static_cast<std::size_t>(cell.column / kTileSide);
}

std::size_t ValueIteration::index(CellIndex cell) const {
  return tile_of(cell) * kTileCells + static_cast<std::size_t>(cell.row % kTileSide) * kTileSide +
         static_cast<std::size_t>(cell.column % kTileSide);
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
  const int row = side == kBottom ? 0 : side == kTop ? kLast : k;
  const int column = side == kLeft ? 0 : side == kRight ? kLast : k;
  return static_cast<std::size_t>(row * kTileSide + column);
}

float ValueIteration::value(CellIndex cell) const {
  return tiles_[tile_of(cell)].is_blank ? kClosed : values_[index(cell)];
}

const float* ValueIteration::goals_of(std::size_t tile) const {
  const auto found = goals_.find(tile);
  return found == goals_.end() ? no_goals_.data() : found->second.data();
}

bool ValueIteration::is_goal(CellIndex cell) const {
  const float own = goals_of(tile_of(cell))[index(cell) % kTileCells];
  return own < kClosed && value(cell) == own;
}

void ValueIteration::unblank(std::size_t tile) {
  if (!tiles_[tile].is_blank) return;
  tiles_[tile].is_blank = false;
  std::fill_n(values_.data() + tile * kTileCells, kTileCells, kClosed);
  copy_edges(tile);
}

void ValueIteration::copy_edges(std::size_t tile) {
  const float* const values = values_.data() + tile * kTileCells;
  for (const Side side : kSides)
    for (int k = 0; k < kTileSide; ++k)
      edges_[tile].values[side][static_cast<std::size_t>(k)] = values[on_side(side, k)];
  tiles_[tile].least = kClosed;
  tiles_[tile].most = 0.0F;
  for (const Edge& edge : edges_[tile].values) {
    for (const float value : edge) {
      tiles_[tile].least = std::min(tiles_[tile].least, value);
      tiles_[tile].most = std::max(tiles_[tile].most, value < kClosed ? value : 0.0F);
    }
  }
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
// Whoever takes a tile from a queue clears what is out of date behind it, so that the top is always true.
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
  const auto away = [](int at, int first) { return std::max({first - at, at - (first + kLast), 0}); };
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
    if (row == kLast) edges[kTop][static_cast<std::size_t>(column)] = change.cost;
    if (column == 0) edges[kLeft][static_cast<std::size_t>(row)] = change.cost;
    if (column == kLast) edges[kRight][static_cast<std::size_t>(row)] = change.cost;

    const float here = value(change.cell);
    if (here == kClosed || change.cost == old) continue;
    for (const Step& step : kSteps) {
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
    tiles_[tile].stirred = {kAll, kAll};
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
  const bool is_inside = row > 0 && column > 0 && row < kLast && column < kLast;
  std::optional<CellIndex> best;
  float least = kClosed;
  for (const Step& step : kSteps) {
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
    tiles_[tile].stirred = {kAll, kAll};
    queue_fall(tile, *std::min_element(of_tile.begin(), of_tile.end()));
  }
}

/// take(index in the tile, offer) for all cells along the border of the tile.
template <class Take>
void ValueIteration::for_offers_into(std::size_t tile, bool firm, Take take) {
  alignas(64) Edge line;
  for (const Side side : kSides) {
    const auto [columns, rows] = kBeyond[side];
    const std::ptrdiff_t from = neighbour(tile, columns, rows);
    if (from < 0 || tiles_[static_cast<std::size_t>(from)].is_blank) continue;
    const Edges& edges = edges_[static_cast<std::size_t>(from)];
    kernels_->offers(edges.values[opposite(side)].data(), edges.costs[opposite(side)].data(), firm, line.data());
    for (int k = 0; k < kTileSide; ++k) take(on_side(side, k), line[static_cast<std::size_t>(k)], side);
    relaxations_ += kOffersALine;
  }
  for (const int rows : {-1, 1}) {
    for (const int columns : {-1, 1}) {
      const std::ptrdiff_t from = neighbour(tile, columns, rows);
      if (from < 0 || tiles_[static_cast<std::size_t>(from)].is_blank) continue;
      const Edges& edges = edges_[static_cast<std::size_t>(from)];
      const Side row_there = rows < 0 ? kTop : kBottom;
      const std::size_t column_there = columns < 0 ? kLast : 0;
      const float value = edges.values[row_there][column_there];
      const float offer = value + edges.costs[row_there][column_there] * kDiagonalStep;
      const Side side = opposite(row_there);
      if (!firm || offer > value) take(on_side(side, columns < 0 ? 0 : kLast), offer, side);
      ++relaxations_;
    }
  }
}

void ValueIteration::settle_tile(std::size_t tile) {
  unblank(tile);
  float* const values = values_.data() + tile * kTileCells;
  const float* const costs = costs_.data() + tile * kTileCells;
  // The bounding box of step (5), for each direction of its own: lines that what fell before them may lower.
  struct Pending {
    std::uint64_t forwards = 0;
    std::uint64_t backwards = 0;
    void after(std::uint64_t fallen) {
      forwards |= fallen << 1U & kAll;
      backwards |= fallen >> 1U;
    }
    [[nodiscard]] bool any() const { return (forwards | backwards) != 0; }
  };
  const Stirred stirred = std::exchange(tiles_[tile].stirred, {});
  std::array<Pending, 2> pending{{{stirred.rows, stirred.rows}, {stirred.columns, stirred.columns}}};
  std::array<int, 4> fallen{};
  for_offers_into(tile, false, [&](std::size_t at, float offer, Side side) {
    if (!(offer < values[at])) return;
    values[at] = offer;
    pending[0].after(std::uint64_t{1} << at / kTileSide);
    pending[1].after(std::uint64_t{1} << at % kTileSide);
    ++fallen[side];
  });
  if (!pending[0].any() && !pending[1].any()) return;

  // Away from where most came in first.
  const std::array<bool, 2> first{fallen[kTop] > fallen[kBottom], fallen[kRight] > fallen[kLeft]};
  bool has_costs_across = false;
  for (bool across = fallen[kLeft] + fallen[kRight] > fallen[kBottom] + fallen[kTop];
       pending[0].any() || pending[1].any(); across = !across) {
    Pending& along = pending[across ? 1 : 0];
    Pending& beside = pending[across ? 0 : 1];
    if (!along.any()) continue;
    float* of = values;
    const float* by = costs;
    if (across) {
      kernels_->transpose(values, scratch_.values.data());
      if (!has_costs_across) kernels_->transpose(costs, scratch_.costs.data());
      has_costs_across = true;
      of = scratch_.values.data();
      by = scratch_.costs.data();
    }
    bool any = false;
    for (const bool backwards : {first[across ? 1 : 0], !first[across ? 1 : 0]}) {
      const std::uint64_t lines = std::exchange(backwards ? along.backwards : along.forwards, 0);
      if (lines == 0) continue;
      const TileChanges fell = kernels_->sweep(of, by, backwards, lines);
      relaxations_ += fell.looked_at * kOffersALine;
      if (backwards) {
        along.forwards |= fell.lines << 1U & kAll;
      } else {
        along.backwards |= fell.lines >> 1U;
      }
      beside.after(fell.lanes);
      any |= fell.lines != 0;
    }
    if (across && any) kernels_->transpose(of, values);
  }
  copy_edges(tile);
  offer_to_neighbours(tile);
}

void ValueIteration::offer_to_neighbours(std::size_t tile) {
  const Edges& own = edges_[tile];
  alignas(64) Edge line;
  for (const Side side : kSides) {
    const auto [columns, rows] = kBeyond[side];
    const std::ptrdiff_t to = neighbour(tile, columns, rows);
    if (to < 0) continue;
    const auto other = static_cast<std::size_t>(to);
    const float* const held = tiles_[other].is_blank ? no_goals_.data() : edges_[other].values[opposite(side)].data();
    kernels_->offers(own.values[side].data(), own.costs[side].data(), false, line.data());
    queue_fall(other, kernels_->least_gain(line.data(), held));
    relaxations_ += kOffersALine;
  }
  for (const int rows : {-1, 1}) {
    for (const int columns : {-1, 1}) {
      const std::ptrdiff_t to = neighbour(tile, columns, rows);
      if (to < 0) continue;
      const auto other = static_cast<std::size_t>(to);
      const Side row_here = rows < 0 ? kBottom : kTop;
      const std::size_t here = columns < 0 ? 0 : kLast;
      const float held = tiles_[other].is_blank ? kClosed : edges_[other].values[opposite(row_here)][kLast - here];
      const float offer = own.values[row_here][here] + own.costs[row_here][here] * kDiagonalStep;
      if (offer < held) queue_fall(other, offer);
      ++relaxations_;
    }
  }
}

void ValueIteration::reset_and_tell(std::size_t tile) {
  const float from = tiles_[tile].lost_from;
  const std::array<Edge, 4> before = edges_[tile].values;
  if (!reset_tile(tile)) return;
  if (!tiles_[tile].is_blank) copy_edges(tile);
  pass_on_losses(tile, before);
  queue_fall(tile, from);
}

/// Whether anything outside a tile without goals holds up any of its values. @pre scratch_.support is that of the tile
bool ValueIteration::is_held_up(std::size_t tile) const {
  const float* const values = values_.data() + tile * kTileCells;
  for (const Side side : kSides) {
    for (int k = 0; k < kTileSide; ++k) {
      const std::size_t at = on_side(side, k);
      if (values[at] < kClosed && scratch_.support[at] <= values[at]) return true;
    }
  }
  return false;
}

/// Forgets a tile without goals.
void ValueIteration::blank(std::size_t tile) {
  Tile& blank = tiles_[tile];
  blank.is_blank = true;
  blank.least = kClosed;
  blank.most = 0.0F;
  blank.lost_rows = 0;
  blank.stirred = {};
  for (Edge& edge : edges_[tile].values) edge.fill(kClosed);
}

/// Step (4) in one tile. @returns whether any value was reset.
bool ValueIteration::reset_tile(std::size_t tile) {
  tiles_[tile].lost_from = kClosed;
  while (!losses_.empty() && losses_.top().first != tiles_[losses_.top().second].lost_from) losses_.pop();
  if (tiles_[tile].is_blank) return false;
  float* const values = values_.data() + tile * kTileCells;
  const float* const costs = costs_.data() + tile * kTileCells;
  const float* const goals = goals_of(tile);
  const bool has_goals = goals != no_goals_.data();
  float* const support = scratch_.support.data();
  std::copy_n(goals, kTileCells, support);
  for_offers_into(tile, true, [&](std::size_t at, float offer, Side) { support[at] = std::min(support[at], offer); });

  if (!has_goals && !is_held_up(tile)) {
    blank(tile);
    return true;
  }
  // A line must be looked at when it or one beside it has lost something; along the other axis likewise.
  Stirred& stirred = tiles_[tile].stirred;
  std::uint64_t lines = std::exchange(tiles_[tile].lost_rows, 0);
  bool any = false;
  bool has_costs_across = false;
  for (bool across = false; lines != 0; across = !across) {
    if (across) {
      kernels_->transpose(values, scratch_.values.data());
      if (!has_costs_across) {
        kernels_->transpose(costs, scratch_.costs.data());
        kernels_->transpose(support, scratch_.support_across.data());
        if (has_goals) kernels_->transpose(goals, scratch_.goals.data());
        has_costs_across = true;
      }
    }
    TileChanges all;
    for (const bool backwards : {false, true}) {
      const TileChanges lost =
          across ? kernels_->reset(scratch_.values.data(), scratch_.costs.data(), scratch_.support_across.data(),
                                   has_goals ? scratch_.goals.data() : goals, backwards, lines)
                 : kernels_->reset(values, costs, support, goals, backwards, lines);
      relaxations_ += lost.looked_at * kOffersALineReset;
      all.lines |= lost.lines;
      all.lanes |= lost.lanes;
      if (lines == 0) break;
    }
    stirred.rows |= across ? all.lanes : all.lines;
    stirred.columns |= across ? all.lines : all.lanes;
    any |= all.lines != 0;
    if (across && all.lines != 0) kernels_->transpose(scratch_.values.data(), values);
    if (lines != 0) lines = (all.lanes << 1U | all.lanes | all.lanes >> 1U) & kAll;
  }
  return any;
}

/// Who leaned on a border that has lost values must be looked at.
void ValueIteration::pass_on_losses(std::size_t tile, const std::array<Edge, 4>& before) {
  const Edges& own = edges_[tile];
  alignas(64) Edge old_line;
  alignas(64) Edge new_line;
  for (const Side side : kSides) {
    const auto [columns, rows] = kBeyond[side];
    const std::ptrdiff_t to = neighbour(tile, columns, rows);
    if (to < 0 || tiles_[static_cast<std::size_t>(to)].is_blank) continue;
    const auto other = static_cast<std::size_t>(to);
    const Edge& held = edges_[other].values[opposite(side)];
    kernels_->offers(before[side].data(), own.costs[side].data(), true, old_line.data());
    kernels_->offers(own.values[side].data(), own.costs[side].data(), true, new_line.data());
    for (std::size_t k = 0; k < kTileSide; ++k)
      if (old_line[k] <= held[k] && held[k] < new_line[k])
        queue_loss(other, held[k], std::uint64_t{1} << on_side(opposite(side), static_cast<int>(k)) / kTileSide);
    relaxations_ += 2 * kOffersALine;
  }
  for (const int rows : {-1, 1}) {
    for (const int columns : {-1, 1}) {
      const std::ptrdiff_t to = neighbour(tile, columns, rows);
      if (to < 0 || tiles_[static_cast<std::size_t>(to)].is_blank) continue;
      const Side row_here = rows < 0 ? kBottom : kTop;
      const std::size_t here = columns < 0 ? 0 : kLast;
      const float held = edges_[static_cast<std::size_t>(to)].values[opposite(row_here)][kLast - here];
      const float step = own.costs[row_here][here] * kDiagonalStep;
      relaxations_ += 2;
      if (before[row_here][here] + step <= held && held < own.values[row_here][here] + step)
        queue_loss(static_cast<std::size_t>(to), held, std::uint64_t{1} << (rows < 0 ? kLast : 0));
    }
  }
}

std::vector<CellIndex> ValueIteration::descend(CellIndex start) const {
  std::vector<CellIndex> way;
  if (!frame_.holds(start) || value(start) == kClosed) return way;
  CellIndex cell = start;
  while (!is_goal(cell)) {
    CellIndex next = cell;
    float least = kClosed;
    for (const Step& step : kSteps) {
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

}  // namespace docent
