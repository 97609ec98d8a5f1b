#include <algorithm>
#include <utility>

#include "docent/planning/value_iteration/tile_layout.h"
#include "docent/planning/value_iteration/value_iteration.h"

// What is done in one tile: it takes what its neighbours offer, sweeps until nothing changes, and offers in turn.

namespace docent::planning {
namespace {

constexpr std::uint64_t kOffersALine =
    std::uint64_t{3} * kTileSide;  ///< in a sweep each cell looks at three neighbours
constexpr std::uint64_t kOffersALineReset = std::uint64_t{8} * kTileSide;
constexpr std::array<std::pair<int, int>, 4> kBeyond{{{0, -1}, {0, 1}, {-1, 0}, {1, 0}}};  ///< the tile beyond a side

}  // namespace

/// What fell in these lines may lower those beside them.
void ValueIteration::Pending::after(std::uint64_t fallen) {
  forwards |= fallen << 1U & kAllLines;
  backwards |= fallen >> 1U;
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
      const std::size_t column_there = columns < 0 ? kLastLine : 0;
      const float value = edges.values[row_there][column_there];
      const float offer = value + edges.costs[row_there][column_there] * kDiagonalStep;
      const Side side = opposite(row_there);
      if (!firm || offer > value) take(on_side(side, columns < 0 ? 0 : kLastLine), offer, side);
      ++relaxations_;
    }
  }
}

/// Sweeps the pending lines along one axis, in one direction and then in the other. @returns whether anything fell.
bool ValueIteration::sweep_both_ways(float* values, const float* costs, bool backwards_first, Pending& along,
                                     Pending& beside) {
  bool any = false;
  for (const bool backwards : {backwards_first, !backwards_first}) {
    const std::uint64_t lines = std::exchange(backwards ? along.backwards : along.forwards, 0);
    if (lines == 0) continue;
    const TileChanges fell = kernels_->sweep(values, costs, backwards, lines);
    relaxations_ += fell.looked_at * kOffersALine;
    if (backwards) {
      along.forwards |= fell.lines << 1U & kAllLines;
    } else {
      along.backwards |= fell.lines >> 1U;
    }
    beside.after(fell.lanes);
    any |= fell.lines != 0;
  }
  return any;
}

void ValueIteration::settle_tile(std::size_t tile) {
  unblank(tile);
  float* const values = values_.data() + tile * kTileCells;
  const float* const costs = costs_.data() + tile * kTileCells;
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
    const bool any = sweep_both_ways(of, by, first[across ? 1 : 0], along, beside);
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
      const std::size_t here = columns < 0 ? 0 : kLastLine;
      const float held = tiles_[other].is_blank ? kClosed : edges_[other].values[opposite(row_here)][kLastLine - here];
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
    if (lines != 0) lines = (all.lanes << 1U | all.lanes | all.lanes >> 1U) & kAllLines;
  }
  return any;
}

/// What leaned on a border that has lost values must be looked at.
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
      const std::size_t here = columns < 0 ? 0 : kLastLine;
      const float held = edges_[static_cast<std::size_t>(to)].values[opposite(row_here)][kLastLine - here];
      const float step = own.costs[row_here][here] * kDiagonalStep;
      relaxations_ += 2;
      if (before[row_here][here] + step <= held && held < own.values[row_here][here] + step)
        queue_loss(static_cast<std::size_t>(to), held, std::uint64_t{1} << (rows < 0 ? kLastLine : 0));
    }
  }
}

}  // namespace docent::planning
