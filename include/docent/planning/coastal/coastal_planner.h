#pragma once

#include <optional>
#include <span>
#include <vector>

#include "docent/base/result.h"
#include "docent/grid/occupancy_grid.h"
#include "docent/planning/coastal/place_information.h"
#include "docent/planning/coastal/uncertainty.h"

namespace docent::planning {

/// Ways that keep near what the lasers can see.
struct CoastalParams {
  /// [1/nat], >= 0, the trade-off: a metre driven with an entropy of u nats above the best costs 1 + weight * u metres.
  /// 0: the shortest way.
  double weight = 0.0;
  double goal_way = 10.0;           ///< [m], >= 0: way driven that the entropy at the goal weighs as much as
  double least_deviation = 0.01;    ///< [m], > 0: of the pose, at the level that costs nothing
  double largest_deviation = 3.0;   ///< [m], more is all the same
  int levels = 24;                  ///< 2..200 of entropy, evenly spaced
  PlaceInformationParams places{};  ///< what a place tells of the pose
  UncertaintyParams uncertainty{};  ///< how the pose is lost and found on the way
  template <class V>
  void visit(V& v) {
    v("weight", weight);
    v("goal_way", goal_way);
    v("least_deviation", least_deviation);
    v("largest_deviation", largest_deviation);
    v("levels", levels);
    v("places", places);
    v("uncertainty", uncertainty);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// Costs [m] of a coarser grid: a cell is open when one of the factor x factor cells under it is, at the least of their
/// costs, times the factor. The finer costs are of a step of one cell.
struct CoastalFloor {
  GridFrame frame;           ///< of the costs
  std::vector<float> costs;  ///< [rows * columns] of entering a cell by a step of its size; infinity: closed
  /// `fine`: of the costs given.
  [[nodiscard]] static CoastalFloor of(const GridFrame& fine, std::span<const float> costs, int factor);
};

/// Coastal navigation [Minerva2000] 5.2: value iteration over (cell, entropy), the belief reduced to its maximum and
/// its entropy (eq. 22). The robot seeks places whose sight tells it where it is, as boats seek the coast.
///
///   V(x, h) <- min over neighbours x' of  C(x') d + weight u(h') d + V(x', h')      (eq. 18)
///
/// with d the length of the step, C the cost of floor, h' the entropy after it (Uncertainty::after, with the
/// information of x' in place of the integral over observations, eq. 19-20), u(h) = h - h_least, and at a goal
/// V = weight goal_way u(h): who arrives without knowing so is not there yet. h' lies between two levels, and V is
/// interpolated between them. The paper's cost is -1 away from the goal and minimized; +1 is meant.
class CoastalPlanner {
 public:
  /// @param floor  from the planner of shortest ways. O(open cells * beams) rays.
  CoastalPlanner(const OccupancyGrid& map, CoastalFloor floor, const CoastalParams& params);

  /// Goals are all open cells within `tolerance` [m], and the open cell nearest to it within 0.8 m. Clears what was
  /// planned before. O(cells log cells): cells are swept in the order of the shortest way's cost.
  void set_goal(Point2 goal, double tolerance);
  /// Sweeps until nothing changes by more than a millimetre or `most_sweeps` are made. O(cells * levels) a sweep.
  /// @returns true when the values have converged
  bool iterate(int most_sweeps);
  [[nodiscard]] bool is_settled() const { return is_settled_; }  ///< the values have converged

  /// V [m] at a place, when the pose is known to `variance` [m2]; infinity where there is no way.
  [[nodiscard]] double value(Point2 in_map, double variance) const;
  /// The best way from a place: centres of cells after `start`, to a goal. Empty: none known.
  [[nodiscard]] std::vector<Point2> way(Point2 start, double variance) const;

  /// Variances [m2] that are to be expected along any way: one a point.
  [[nodiscard]] std::vector<double> variances_along(Point2 start, std::span<const Point2> way, double variance) const;
  [[nodiscard]] const InformationMap& information() const { return information_; }  ///< what each place tells
  [[nodiscard]] const Uncertainty& uncertainty() const { return uncertainty_; }     ///< how levels follow one another
  [[nodiscard]] const GridFrame& frame() const { return floor_.frame; }             ///< of its cells

 private:
  struct Step {
    int columns = 0, rows = 0;
    bool is_diagonal = false;
  };
  [[nodiscard]] double level_of(double variance) const;  ///< 0..levels-1, not whole
  [[nodiscard]] double variance_at(double level) const;
  [[nodiscard]] float value_at(std::size_t cell, double level) const;
  [[nodiscard]] double step_length(const Step& step) const;
  [[nodiscard]] float step_cost(std::size_t to, const Step& step, double level_after) const;
  void foretell();
  bool relax(std::size_t cell);
  void order_cells();
  template <class Visit>
  void for_neighbours(std::size_t cell, Visit visit) const;  ///< visit(open neighbour, step)
  [[nodiscard]] Point2 centre_of(std::size_t cell) const;
  [[nodiscard]] static double cells_of(const Step& step);  ///< length in cells
  [[nodiscard]] std::optional<std::size_t> nearest_open(Point2 in_map) const;
  [[nodiscard]] const float* levels_after(std::size_t to, bool is_diagonal) const;

  CoastalParams params_;
  CoastalFloor floor_;
  InformationMap information_;
  Uncertainty uncertainty_;
  std::vector<std::array<double, 3>> eigenvalues_;  ///< [rows * columns]
  std::array<Step, 8> steps_;
  std::vector<float> after_;  ///< [open cells][straight, diagonal][levels]: the level after a step into the cell
  std::vector<std::uint32_t> open_index_;  ///< [rows * columns] row of after_
  std::vector<float> values_;              ///< [rows * columns][levels]
  std::vector<bool> is_goal_;
  std::vector<bool> is_stale_;        ///< a neighbour changed since the cell was relaxed
  std::vector<std::uint32_t> order_;  ///< open cells from which a goal is reached, by the shortest way's cost
  bool forward_ = true;
  bool is_settled_ = false;
};

}  // namespace docent::planning
