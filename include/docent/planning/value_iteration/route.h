#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/geometry/polygon.h"
#include "docent/grid/clearance.h"
#include "docent/grid/occupancy_grid.h"
#include "docent/planning/value_iteration/value_iteration.h"

namespace docent::planning {

/// What makes floor dear or closed to a way.
struct RouteParams {
  int coarsening = 3;             ///< planning cell = so many map cells
  double robot_radius = 0.265;    ///< [m] set to body.radius
  Clearance clearance;            ///< that a way must leave
  double comfort = 0.8;           ///< [m] beyond which clearance costs nothing
  double comfort_cost = 2.0;      ///< extra cost, as a factor, at the least clearance
  double obstacle_cost = 8.0;     ///< factor for cells that are blocked now by what is not in the map
  double obstacle_margin = 0.35;  ///< [m] round such cells
  double obstacle_comfort = 0.9;  ///< [m] from such cells beyond which they cost nothing: a way keeps off who stands
  double obstacle_comfort_cost = 3.0;  ///< extra cost, as a factor, at the margin
  double settled_cost = 90.0;          ///< factor for cells where something has stood for long
  bool settled_closed = false;         ///< such cells are closed, not dear: only a look from elsewhere frees them
  double lane_width = 0.6;             ///< [m] of the lane round a preferred way
  double lane_cost = 2.0;              ///< extra cost, as a factor, a metre and more beside the lane
  double switch_gain = 0.10;           ///< share of its cost by which another way must be better than the one held
  double aside = 1.2;                  ///< [m] from the way held: within it a step aside is no other way
  template <class V>
  void visit(V& v) {
    v("coarsening", coarsening);
    v("robot_radius", robot_radius);
    v("clearance", clearance);
    v("comfort", comfort);
    v("comfort_cost", comfort_cost);
    v("obstacle_cost", obstacle_cost);
    v("obstacle_margin", obstacle_margin);
    v("obstacle_comfort", obstacle_comfort);
    v("obstacle_comfort_cost", obstacle_comfort_cost);
    v("settled_cost", settled_cost);
    v("settled_closed", settled_closed);
    v("lane_width", lane_width);
    v("lane_cost", lane_cost);
    v("switch_gain", switch_gain);
    v("aside", aside);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// Cells from `low` to `high`, both among them.
struct CellBox {
  CellIndex low;   ///< lower left
  CellIndex high;  ///< upper right
};

/// Plans for a disc-shaped robot in a museum's map: costs of cells from clearance, value iteration, and the way as a
/// line of points. Cells behind walls, hazards and the area's border are closed; what is seen now and not in the map is
/// dear but not closed, for people move.
class RoutePlanner {
 public:
  /// @param hazards  polygons that must not be touched; @param area  the robot's centre stays inside; empty: everywhere
  RoutePlanner(const OccupancyGrid& map, std::span<const Polygon> hazards, const Polygon& area, RouteParams params);

  /// @param obstacles  [rows * columns of frame()] true where something stands now that the map does not show
  /// @param settled  likewise, those of them that have stood there for long; empty: none
  /// @param within  where they may differ from those set last; nullopt: anywhere
  /// Changes costs only around what changed: O(cells within) bits compared, O(box of the changes) beyond.
  void set_obstacles(const std::vector<bool>& obstacles, const std::vector<bool>& settled = {},
                     const std::optional<CellBox>& within = std::nullopt);
  /// From now on the robot would rather go along this line of points (map): floor beside it is dearer. For ways that
  /// another planner found; what is closed stays closed, and obstacles are driven round. Empty: no preference.
  void prefer(std::span<const Point2> way);
  /// Every cell within `tolerance` [m] of the goal is a goal. Clears what was planned before.
  void set_goal(Point2 goal, double tolerance) { set_goals({&goal, 1}, tolerance); }
  /// Several goals at once: ways lead to the one that is nearest by cost.
  void set_goals(std::span<const Point2> goals, double tolerance);
  /// Works on all values, see ValueIteration::iterate. @returns true when converged
  bool iterate(int most_visits) { return is_settled_ = planner_.iterate(most_visits); }
  /// Works until the way from `start` is the best one, whatever is not final elsewhere. @returns true when it is
  bool settle(Point2 start, int most_visits);
  /// False while `iterate` or `settle` may still find a way or a better one.
  [[nodiscard]] bool is_settled() const { return is_settled_; }

  /// Decides which way to follow from `start`: the one held, as long as it leads on from here and no other is better by
  /// `switch_gain`. So two ways that cost the same do not take turns when noise favours now the one and now the other.
  /// A person on it is passed within `aside` of it, where there is room and that is hardly longer; what closes it, or
  /// what cannot be passed there, makes it as dear as it is.
  void hold_way(Point2 start);

  /// The way from `start` (map) to the goal, along the one held where there is one: points some centimetres apart,
  /// smoothed, start excluded. Empty: no way known.
  [[nodiscard]] std::vector<Point2> way(Point2 start) const;
  [[nodiscard]] bool is_closed(Point2 in_map) const;                         ///< the robot cannot be there
  [[nodiscard]] const GridFrame& frame() const { return planner_.frame(); }  ///< of the planning cells
  [[nodiscard]] const ValueIteration& values() const { return planner_; }    ///< for pictures
  /// [rows * columns of frame()] costs of cells in metres of free floor, without obstacles and preferences; infinity:
  /// closed.
  [[nodiscard]] std::span<const float> static_costs() const { return static_costs_; }
  /// Cost of the way from `start` in metres of free floor; infinity where there is none.
  [[nodiscard]] double cost_from(Point2 start) const;

 private:
  [[nodiscard]] std::optional<CellIndex> nearest_open(Point2 in_map, double within) const;
  [[nodiscard]] float obstacle_factor(double away) const;
  [[nodiscard]] float cost_at(std::size_t cell) const;
  void apply_costs();
  /// The obstacles changed within these cells, corners included.
  void apply_obstacles(CellIndex low, CellIndex high);
  [[nodiscard]] double line_cost(Point2 from, Point2 to, float most_cost) const;
  [[nodiscard]] std::size_t nearest_held(Point2 start) const;
  [[nodiscard]] double cost_of(std::span<const CellIndex> way, bool unmoved) const;
  [[nodiscard]] std::vector<std::size_t> list_beside_chosen();
  [[nodiscard]] std::vector<CellIndex> best_beside_chosen(CellIndex start);
  [[nodiscard]] std::vector<CellIndex> cells_from(Point2 start) const;

  RouteParams params_;
  ValueIteration planner_;
  bool is_settled_ = false;
  std::vector<float> static_costs_;  ///< [rows * columns]
  std::vector<float> lane_factors_;  ///< [rows * columns] of a preferred way, >= 1; empty: none
  std::vector<float> near_factors_;  ///< [rows * columns] of obstacles, >= 1
  std::vector<bool> obstacles_;      ///< [rows * columns] as last set
  std::vector<bool> settled_;        ///< [rows * columns] as last set
  static constexpr std::int32_t kNowhere = -1;
  std::vector<std::int32_t> places_;  ///< [rows * columns] scratch: in a list of cells, or kNowhere
  std::vector<CellIndex> held_;       ///< the way that is followed, to a goal
  std::vector<CellIndex> chosen_;     ///< the same before any step aside
};

}  // namespace docent::planning
