#include "docent/planning/exploration/explorer.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "docent/planning/value_iteration/value_iteration.h"

namespace docent::planning {
namespace {

constexpr int kEnough = std::numeric_limits<int>::max();
constexpr double kSamePlace = 1.0;  ///< [m] from the last goal: still the same thing to explore

bool is_unknown(std::int8_t cell) { return cell < 0; }

bool borders_on_free(const OccupancyGrid& map, CellIndex cell) {
  for (int row = -1; row <= 1; ++row)
    for (int column = -1; column <= 1; ++column)
      if (map.is_free({cell.column + column, cell.row + row})) return true;
  return false;
}

/// The open cell nearest to the robot, which may stand a little nearer to something than it plans to.
std::optional<CellIndex> start_cell(const ValueIteration& planner, Point2 robot) {
  constexpr double kNear = 0.5;  // [m]
  const GridFrame& frame = planner.frame();
  const CellIndex centre = frame.cell_at(robot);
  const int reach = static_cast<int>(std::ceil(kNear / frame.resolution));
  std::optional<CellIndex> best;
  double least = kNear;
  for (int row = centre.row - reach; row <= centre.row + reach; ++row) {
    for (int column = centre.column - reach; column <= centre.column + reach; ++column) {
      const CellIndex cell{column, row};
      if (!frame.holds(cell) || planner.cost(cell) == ValueIteration::kClosed) continue;
      const double off = distance(frame.centre(cell), robot);
      if (off >= least) continue;
      least = off;
      best = cell;
    }
  }
  return best;
}

}  // namespace

Result<void> ExplorerParams::validate() const {
  if (coarsening < 1 || coarsening > 20) return fail("coarsening must be in 1..20");
  if (!(robot_radius > 0.0)) return fail("robot_radius must be > 0");
  if (!(wall_margin >= 0.0)) return fail("wall_margin must be >= 0");
  if (!(comfort >= 0.0)) return fail("comfort must be >= 0");
  if (!(comfort_cost >= 0.0)) return fail("comfort_cost must be >= 0");
  if (!(switch_cost >= 0.0)) return fail("switch_cost must be >= 0");
  return {};
}

bool Explorer::is_given_up(Point2 place, double within) const {
  return std::any_of(given_up_.begin(), given_up_.end(), [&](Point2 p) { return distance(p, place) < within; });
}

std::optional<Exploration> Explorer::next(const OccupancyGrid& map, Point2 robot) {
  const OccupancyGrid coarse = coarsened(map, params_.coarsening);
  const GridFrame& frame = coarse.frame;
  std::vector<bool> solid(frame.size());
  for (std::size_t i = 0; i < solid.size(); ++i) solid[i] = coarse.cells[i] >= 65;
  const auto clearances = distance_transform(frame, solid);

  std::vector<float> costs(frame.size(), ValueIteration::kClosed);
  std::vector<ValueIteration::Goal> goals;
  for (int row = 0; row < frame.rows; ++row) {
    for (int column = 0; column < frame.columns; ++column) {
      const CellIndex cell{column, row};
      const std::size_t i = frame.index(cell);
      const double spare = static_cast<double>(clearances[i]) - params_.robot_radius - params_.wall_margin;
      if (spare < 0.0 || (!is_unknown(coarse.cells[i]) && !coarse.is_free(cell))) continue;
      if (!is_unknown(coarse.cells[i])) {
        const double discomfort = params_.comfort > 0.0 ? std::max(0.0, 1.0 - spare / params_.comfort) : 0.0;
        costs[i] = static_cast<float>(frame.resolution * (1.0 + params_.comfort_cost * discomfort * discomfort));
        continue;
      }
      if (!borders_on_free(coarse, cell)) continue;
      const Point2 place = frame.centre(cell);
      if (distance(place, robot) < params_.robot_radius + frame.resolution && !is_given_up(place, frame.resolution))
        given_up_.push_back(place);
      if (is_given_up(place, frame.resolution)) continue;
      costs[i] = static_cast<float>(frame.resolution);
      const bool is_same = !last_ || distance(*last_, place) < kSamePlace;
      goals.push_back({cell, is_same ? 0.0F : static_cast<float>(params_.switch_cost)});
    }
  }

  ValueIteration planner{frame};
  planner.set_costs(costs);
  planner.set_goals(goals);
  const auto start = start_cell(planner, robot);
  if (!start || !planner.settle(*start, kEnough)) return std::nullopt;
  Exploration result;
  for (const CellIndex& cell : planner.descend(*start)) result.way.push_back(frame.centre(cell));
  if (result.way.empty()) return std::nullopt;
  result.cost = static_cast<double>(planner.value(*start));
  result.frontier = goals.size();
  last_ = result.way.back();
  return result;
}

}  // namespace docent::planning
