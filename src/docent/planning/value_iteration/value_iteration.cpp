#include "docent/planning/value_iteration/value_iteration.h"

#include <algorithm>
#include <array>
#include <numbers>

#include "docent/base/check.h"

namespace docent {
namespace {

constexpr auto kDiagonal = static_cast<float>(std::numbers::sqrt2);

struct Step {
  int column;
  int row;
  float length;
};
constexpr std::array<Step, 8> kSteps{{{1, 0, 1.0F},
                                      {0, 1, 1.0F},
                                      {-1, 0, 1.0F},
                                      {0, -1, 1.0F},
                                      {1, 1, kDiagonal},
                                      {-1, 1, kDiagonal},
                                      {-1, -1, kDiagonal},
                                      {1, -1, kDiagonal}}};

}  // namespace

void ValueIteration::Box::include(int column, int row) {
  if (empty()) {
    *this = {column, column, row, row};
    return;
  }
  column_min = std::min(column_min, column);
  column_max = std::max(column_max, column);
  row_min = std::min(row_min, row);
  row_max = std::max(row_max, row);
}

ValueIteration::ValueIteration(const GridFrame& frame)
    : frame_{frame}, stride_{static_cast<std::size_t>(frame.columns) + 2} {
  const std::size_t size = stride_ * (static_cast<std::size_t>(frame.rows) + 2);
  costs_.assign(size, kClosed);
  values_.assign(size, kClosed);
  is_goal_.assign(size, false);
}

float ValueIteration::best_through_neighbours(std::size_t at) const {
  const float* v = values_.data() + at;
  const float* c = costs_.data() + at;
  const auto s = static_cast<std::ptrdiff_t>(stride_);
  const float straight = std::min(std::min(v[1] + c[1], v[-1] + c[-1]), std::min(v[s] + c[s], v[-s] + c[-s]));
  const float slant = std::min(std::min(v[s + 1] + c[s + 1] * kDiagonal, v[s - 1] + c[s - 1] * kDiagonal),
                               std::min(v[-s + 1] + c[-s + 1] * kDiagonal, v[-s - 1] + c[-s - 1] * kDiagonal));
  return std::min(straight, slant);
}

void ValueIteration::touch(int column, int row) {
  box_.include(std::max(column - 1, 0), std::max(row - 1, 0));
  box_.include(std::min(column + 1, frame_.columns - 1), std::min(row + 1, frame_.rows - 1));
}

/// Visits every cell of the box, in reading order or against it; `visit(index)` says whether it changed the value.
template <class Visit>
bool ValueIteration::sweep(bool forward, Visit visit) {
  const Box box = box_;
  box_ = {};
  if (box.empty()) return false;
  bool changed = false;
  const int rows = box.row_max - box.row_min + 1;
  const int columns = box.column_max - box.column_min + 1;
  for (int i = 0; i < rows; ++i) {
    const int row = forward ? box.row_min + i : box.row_max - i;
    for (int k = 0; k < columns; ++k) {
      const int column = forward ? box.column_min + k : box.column_max - k;
      if (visit(padded({column, row}))) {
        changed = true;
        touch(column, row);
      }
    }
  }
  relaxations_ += static_cast<std::uint64_t>(rows) * static_cast<std::uint64_t>(columns);
  return changed;
}

void ValueIteration::set_costs(std::span<const float> costs) {
  DOCENT_CHECK(costs.size() == frame_.size());
  Box pending = box_;  // what had not converged before
  box_ = {};
  for (int row = 0; row < frame_.rows; ++row) {
    for (int column = 0; column < frame_.columns; ++column) {
      const std::size_t at = padded({column, row});
      const float cost = costs[frame_.index({column, row})];
      if (cost == costs_[at]) continue;
      costs_[at] = cost;
      touch(column, row);
    }
  }
  if (box_.empty() && pending.empty()) return;
  const auto keep = [&pending](const Box& box) {
    if (box.empty()) return;
    pending.include(box.column_min, box.row_min);
    pending.include(box.column_max, box.row_max);
  };
  keep(box_);
  // Step (4): a value below what its neighbours support has lost its ground. Resetting it may take the ground of
  // others.
  bool forward = true;
  while (sweep(forward, [this](std::size_t at) {
    if (is_goal_[at] || values_[at] == kClosed || !(values_[at] < best_through_neighbours(at))) return false;
    values_[at] = kClosed;
    return true;
  })) {
    keep(box_);
    forward = !forward;
  }
  box_ = pending;
}

void ValueIteration::set_goals(std::span<const Goal> goals) {
  std::fill(values_.begin(), values_.end(), kClosed);
  std::fill(is_goal_.begin(), is_goal_.end(), false);
  box_ = {};
  for (const Goal& goal : goals) {
    if (!frame_.holds(goal.cell)) continue;
    const std::size_t at = padded(goal.cell);
    values_[at] = std::min(values_[at], goal.value);
    is_goal_[at] = true;
    touch(goal.cell.column, goal.cell.row);
  }
}

bool ValueIteration::iterate(int most_sweeps) {
  for (int i = 0; i < most_sweeps; ++i) {
    const bool changed = sweep(forward_, [this](std::size_t at) {
      if (is_goal_[at]) return false;
      const float best = best_through_neighbours(at);
      if (!(best < values_[at])) return false;
      values_[at] = best;
      return true;
    });
    forward_ = !forward_;
    if (!changed) return true;
  }
  return box_.empty();
}

std::vector<CellIndex> ValueIteration::descend(CellIndex start) const {
  std::vector<CellIndex> way;
  if (!frame_.holds(start) || value(start) == kClosed) return way;
  CellIndex cell = start;
  while (!is_goal_[padded(cell)]) {
    CellIndex next = cell;
    float least = kClosed;
    for (const Step& step : kSteps) {
      const CellIndex neighbour{cell.column + step.column, cell.row + step.row};
      const std::size_t at = padded(neighbour);
      const float through = values_[at] + costs_[at] * step.length;
      if (through < least) {
        least = through;
        next = neighbour;
      }
    }
    // Before convergence a circle is possible: every step must go down.
    if (least == kClosed || !(value(next) < value(cell))) return {};
    way.push_back(next);
    cell = next;
  }
  return way;
}

}  // namespace docent
