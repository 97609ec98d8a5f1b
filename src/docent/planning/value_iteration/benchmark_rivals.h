#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <queue>
#include <utility>
#include <vector>

#include "docent/planning/value_iteration/benchmark_buildings.h"

// What value_iteration_benchmark.cpp compares value iteration with.
//
// Dijkstra is meant to be fair: flat arrays with a closed border, so that nothing tests bounds, entries of eight
// bytes, nothing allocated while it runs.

namespace docent::planning::benchmarks {

/// Backwards from the goal, over a grid with a closed border.
class Dijkstra {
 public:
  Dijkstra(const GridFrame& frame, const std::vector<float>& costs)
      : frame_{frame}, stride_{static_cast<std::size_t>(frame.columns) + 2} {
    costs_.assign(stride_ * (static_cast<std::size_t>(frame.rows) + 2), ValueIteration::kClosed);
    for (int row = 0; row < frame.rows; ++row)
      for (int column = 0; column < frame.columns; ++column)
        costs_[index({column, row})] = costs[frame.index({column, row})];
    values_.resize(costs_.size());
    std::vector<Entry> room;
    room.reserve(costs_.size());
    queue_ = Queue{std::greater<>{}, std::move(room)};
  }
  void solve(CellIndex goal) {
    std::fill(values_.begin(), values_.end(), ValueIteration::kClosed);
    const auto s = static_cast<std::ptrdiff_t>(stride_);
    const std::array<std::ptrdiff_t, 8> steps{1, -1, s, -s, s + 1, s - 1, 1 - s, -s - 1};
    values_[index(goal)] = 0.0F;
    queue_.push({0.0F, static_cast<std::uint32_t>(index(goal))});
    while (!queue_.empty()) {
      const auto [value, at] = queue_.top();
      queue_.pop();
      if (value > values_[at]) continue;
      const float cost = costs_[at];
      if (cost == ValueIteration::kClosed) continue;  // nobody goes through here
      const float straight = value + cost;
      const float aslant = value + cost * std::numbers::sqrt2_v<float>;
      relaxations_ += 8;
      for (std::size_t i = 0; i < steps.size(); ++i) {
        const std::size_t beside = at + static_cast<std::size_t>(steps[i]);
        const float through = i < 4 ? straight : aslant;
        if (through < values_[beside]) {
          values_[beside] = through;
          queue_.push({through, static_cast<std::uint32_t>(beside)});
        }
      }
    }
  }
  [[nodiscard]] float value(CellIndex cell) const { return values_[index(cell)]; }
  [[nodiscard]] std::uint64_t relaxations() const { return relaxations_; }

 private:
  using Entry = std::pair<float, std::uint32_t>;
  using Queue = std::priority_queue<Entry, std::vector<Entry>, std::greater<>>;
  [[nodiscard]] std::size_t index(CellIndex cell) const {
    return static_cast<std::size_t>(cell.row + 1) * stride_ + static_cast<std::size_t>(cell.column + 1);
  }
  GridFrame frame_;
  std::size_t stride_;
  std::vector<float> costs_, values_;
  Queue queue_;
  std::uint64_t relaxations_ = 0;
};

/// What ROS has planned with since 2009, potentials spread in waves: each cell's is interpolated from its lower
/// neighbours in both directions, and cells wait in three blocks, for this wave, the next one, and beyond the present
/// threshold. Costs are whole numbers. Its potentials are not the shortest ways over eight neighbours that the others
/// find, and nearly Euclidean; so only its time is compared.
class WavePropagation {
 public:
  WavePropagation(const GridFrame& frame, const std::vector<float>& costs)
      : stride_{static_cast<std::size_t>(frame.columns) + 2} {
    const std::size_t size = stride_ * (static_cast<std::size_t>(frame.rows) + 2);
    costs_.assign(size, kObstacle);
    for (int row = 0; row < frame.rows; ++row) {
      for (int column = 0; column < frame.columns; ++column) {
        const float cost = costs[frame.index({column, row})];
        if (cost < ValueIteration::kClosed)
          costs_[index({column, row})] = kNeutral * cost / static_cast<float>(kResolution);
      }
    }
    potentials_.resize(size);
    is_waiting_.resize(size);
    for (auto* const block : {&now_, &next_, &beyond_}) block->reserve(size);
  }
  void solve(CellIndex goal) {
    std::fill(potentials_.begin(), potentials_.end(), kFar);
    std::fill(is_waiting_.begin(), is_waiting_.end(), std::uint8_t{0});
    for (auto* const block : {&now_, &next_, &beyond_}) block->clear();
    threshold_ = kObstacle;
    const std::size_t at = index(goal);
    potentials_[at] = 0.0F;
    for (const std::size_t beside : {at + 1, at - 1, at + stride_, at - stride_}) wait(beside, now_);
    while (!now_.empty()) {
      for (const std::uint32_t cell : now_) is_waiting_[cell] = 0;
      for (const std::uint32_t cell : now_) update(cell);
      now_.swap(next_);
      next_.clear();
      if (!now_.empty()) continue;
      threshold_ += 2.0F * kNeutral;
      now_.swap(beyond_);
      beyond_.clear();
    }
  }
  [[nodiscard]] bool is_reached(CellIndex cell) const { return potentials_[index(cell)] < kFar; }

 private:
  static constexpr float kNeutral = 50.0F;
  static constexpr float kObstacle = 254.0F;
  static constexpr float kFar = 1e10F;

  [[nodiscard]] std::size_t index(CellIndex cell) const {
    return static_cast<std::size_t>(cell.row + 1) * stride_ + static_cast<std::size_t>(cell.column + 1);
  }
  void wait(std::size_t cell, std::vector<std::uint32_t>& block) {
    if (is_waiting_[cell] != 0 || costs_[cell] >= kObstacle) return;
    is_waiting_[cell] = 1;
    block.push_back(static_cast<std::uint32_t>(cell));
  }
  void update(std::size_t cell) {
    const float left = potentials_[cell - 1];
    const float right = potentials_[cell + 1];
    const float below = potentials_[cell - stride_];
    const float above = potentials_[cell + stride_];
    const float across = std::min(left, right);
    const float along = std::min(below, above);
    const float cost = costs_[cell];
    const float apart = std::abs(across - along);
    float potential = std::min(across, along) + cost;
    if (apart < cost) {  // a plane wave through both neighbours, by a parabola
      const float share = apart / cost;
      potential = std::min(across, along) + cost * (-0.2301F * share * share + 0.5307F * share + 0.7040F);
    }
    if (potential >= potentials_[cell]) return;
    potentials_[cell] = potential;
    auto& block = potential < threshold_ ? next_ : beyond_;
    const float step = std::numbers::sqrt2_v<float> / 2.0F;
    if (left > potential + step * costs_[cell - 1]) wait(cell - 1, block);
    if (right > potential + step * costs_[cell + 1]) wait(cell + 1, block);
    if (below > potential + step * costs_[cell - stride_]) wait(cell - stride_, block);
    if (above > potential + step * costs_[cell + stride_]) wait(cell + stride_, block);
  }

  std::size_t stride_;
  std::vector<float> costs_, potentials_;
  std::vector<std::uint8_t> is_waiting_;
  std::vector<std::uint32_t> now_, next_, beyond_;
  float threshold_ = 0.0F;
};

}  // namespace docent::planning::benchmarks
