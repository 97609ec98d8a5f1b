#pragma once

#include <span>
#include <vector>

#include "docent/grid/occupancy_grid.h"

namespace docent {

/// Value iteration on a grid [Burgard1999, section 4.2, steps (1), (2), (4), (5)]: V of a cell is the least cost of a
/// way to the nearest goal, where entering a neighbour costs that neighbour's cost times the step's length in cells.
///
/// Any-time: between calls of `iterate` every value is an upper bound on the true one, and steepest descent is
/// already a way to a goal wherever the value is finite. A change of costs resets only values that have become too
/// small.
class ValueIteration {
 public:
  static constexpr float kClosed = std::numeric_limits<float>::infinity();

  struct Goal {
    CellIndex cell;
    float value = 0.0F;  ///< cost that stands in for the rest of the way; 0 for the goal itself
  };

  /// @param frame  where the cells lie. All cells are closed until set_costs.
  explicit ValueIteration(const GridFrame& frame);

  /// @param costs  [rows * columns] cost of entering a cell, > 0; kClosed where the robot cannot be. Values that are
  /// now too small are reset (selective reset); those that are too large are lowered by `iterate`.
  void set_costs(std::span<const float> costs);
  /// Starts over for these goals; goals on closed cells count as well.
  void set_goals(std::span<const Goal> goals);

  /// Sweeps over the bounding box of what may still change until nothing does or `most_sweeps` are made.
  /// @returns true when the values have converged. O(cells in the box) a sweep.
  bool iterate(int most_sweeps);

  [[nodiscard]] float value(CellIndex cell) const { return values_[padded(cell)]; }
  [[nodiscard]] float cost(CellIndex cell) const { return costs_[padded(cell)]; }
  [[nodiscard]] const GridFrame& frame() const { return frame_; }
  /// Relaxations made so far, for benchmarks.
  [[nodiscard]] std::uint64_t relaxations() const { return relaxations_; }

  /// Steepest descent in V from `start` (step (3)): the cells after it to a goal. Empty where no way is known.
  [[nodiscard]] std::vector<CellIndex> descend(CellIndex start) const;

 private:
  struct Box {
    int column_min = 0, column_max = -1, row_min = 0, row_max = -1;
    [[nodiscard]] bool empty() const { return column_max < column_min; }
    void include(int column, int row);
  };
  [[nodiscard]] std::size_t padded(CellIndex cell) const {
    return static_cast<std::size_t>(cell.row + 1) * stride_ + static_cast<std::size_t>(cell.column + 1);
  }
  [[nodiscard]] float best_through_neighbours(std::size_t at) const;
  template <class Visit>
  bool sweep(bool forward, Visit visit);
  void touch(int column, int row);

  GridFrame frame_;
  std::size_t stride_;         ///< columns + 2: a closed border spares all tests of bounds
  std::vector<float> costs_;   ///< padded
  std::vector<float> values_;  ///< padded
  std::vector<bool> is_goal_;  ///< padded
  Box box_;
  bool forward_ = true;
  std::uint64_t relaxations_ = 0;
};

}  // namespace docent
