#include "docent/planning/value_iteration/route.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>
#include <utility>

namespace docent::planning {

Result<void> RouteParams::validate() const {
  if (coarsening < 1 || coarsening > 20) return fail("coarsening must be in 1..20");
  if (!(robot_radius > 0.0)) return fail("robot_radius must be > 0");
  if (auto valid = clearance.validate(); !valid) return valid;
  if (!(comfort >= 0.0)) return fail("comfort must be >= 0");
  if (!(comfort_cost >= 0.0)) return fail("comfort_cost must be >= 0");
  if (!(obstacle_cost >= 1.0)) return fail("obstacle_cost must be >= 1");
  if (!(obstacle_margin >= 0.0)) return fail("obstacle_margin must be >= 0");
  if (!(obstacle_comfort >= obstacle_margin)) return fail("obstacle_comfort must be >= obstacle_margin");
  if (!(obstacle_comfort_cost >= 0.0)) return fail("obstacle_comfort_cost must be >= 0");
  if (!(settled_cost >= obstacle_cost)) return fail("settled_cost must be >= obstacle_cost");
  if (!(lane_width >= 0.0)) return fail("lane_width must be >= 0");
  if (!(lane_cost >= 0.0)) return fail("lane_cost must be >= 0");
  if (!(switch_gain >= 0.0)) return fail("switch_gain must be >= 0");
  if (!(aside >= 0.0)) return fail("aside must be >= 0");
  return {};
}

namespace {

constexpr double kNear = 0.6;   ///< [m] from a place where the robot cannot be to one where a way begins
constexpr double kAlong = 0.5;  ///< [m] from the way held, within which it is followed

}  // namespace

RoutePlanner::RoutePlanner(const OccupancyGrid& map, std::span<const Polygon> hazards, const Polygon& area,
                           RouteParams params)
    : params_{params}, planner_{coarse_frame(map.frame, params.coarsening)} {
  const auto spares = spare_room(map, hazards, area, params_.robot_radius, params_.clearance, params_.coarsening);
  const GridFrame& frame = planner_.frame();
  static_costs_.assign(frame.size(), ValueIteration::kClosed);
  near_factors_.assign(frame.size(), 1.0F);
  obstacles_.assign(frame.size(), false);
  settled_.assign(frame.size(), false);
  for (std::size_t i = 0; i < spares.size(); ++i) {
    if (spares[i] < 0.0) continue;
    const double discomfort = params_.comfort > 0.0 ? std::max(0.0, 1.0 - spares[i] / params_.comfort) : 0.0;
    static_costs_[i] = static_cast<float>(frame.resolution * (1.0 + params_.comfort_cost * discomfort * discomfort));
  }
  planner_.set_costs(static_costs_);
}

/// @param away  [m] from the nearest obstacle that is not in the map
float RoutePlanner::obstacle_factor(double away) const {
  if (away <= params_.obstacle_margin) return static_cast<float>(params_.obstacle_cost);
  if (away >= params_.obstacle_comfort) return 1.0F;
  const double near = (params_.obstacle_comfort - away) / (params_.obstacle_comfort - params_.obstacle_margin);
  return static_cast<float>(1.0 + params_.obstacle_comfort_cost * near * near);
}

void RoutePlanner::set_obstacles(const std::vector<bool>& obstacles, const std::vector<bool>& settled,
                                 const std::optional<CellBox>& within) {
  const GridFrame& frame = planner_.frame();
  const CellBox part = within.value_or(CellBox{{0, 0}, {frame.columns - 1, frame.rows - 1}});
  const auto is_still = [&](std::size_t i) { return !settled.empty() && settled[i]; };
  CellIndex low{frame.columns, frame.rows};
  CellIndex high{-1, -1};
  for (int row = part.low.row; row <= part.high.row; ++row) {
    for (int column = part.low.column; column <= part.high.column; ++column) {
      const std::size_t i = frame.index({column, row});
      if (obstacles_[i] == obstacles[i] && settled_[i] == is_still(i)) continue;
      obstacles_[i] = obstacles[i];
      settled_[i] = is_still(i);
      low = {std::min(low.column, column), std::min(low.row, row)};
      high = {std::max(high.column, column), std::max(high.row, row)};
    }
  }
  if (high.column >= 0) apply_obstacles(low, high);
}

void RoutePlanner::apply_obstacles(CellIndex low, CellIndex high) {
  const GridFrame& frame = planner_.frame();
  const int reach = 1 + static_cast<int>(params_.obstacle_comfort / frame.resolution);
  const auto grown = [&](CellIndex& least, CellIndex& most) {
    least = {std::max(0, least.column - reach), std::max(0, least.row - reach)};
    most = {std::min(frame.columns - 1, most.column + reach), std::min(frame.rows - 1, most.row + reach)};
  };
  grown(low, high);  // the cells that become dearer or cheaper ...
  CellIndex first = low;
  CellIndex last = high;
  grown(first, last);  // ... and what stands near enough to count there
  const GridFrame part{last.column - first.column + 1, last.row - first.row + 1, frame.resolution, {}};
  std::vector<bool> near(part.size());
  std::vector<bool> near_settled(part.size());
  for (int row = 0; row < part.rows; ++row) {
    for (int column = 0; column < part.columns; ++column) {
      const std::size_t i = frame.index({first.column + column, first.row + row});
      near[part.index({column, row})] = obstacles_[i];
      near_settled[part.index({column, row})] = settled_[i];
    }
  }
  const bool any_settled = std::find(near_settled.begin(), near_settled.end(), true) != near_settled.end();
  const auto away = distance_transform(part, near);
  const auto from_settled = any_settled ? distance_transform(part, near_settled) : std::vector<float>{};
  const float dear = params_.settled_closed ? ValueIteration::kClosed : static_cast<float>(params_.settled_cost);
  std::vector<ValueIteration::Change> changes;
  for (int row = low.row; row <= high.row; ++row) {
    for (int column = low.column; column <= high.column; ++column) {
      const std::size_t i = frame.index({column, row});
      const std::size_t k = part.index({column - first.column, row - first.row});
      float factor = obstacle_factor(static_cast<double>(away[k]));
      if (any_settled && static_cast<double>(from_settled[k]) <= params_.obstacle_margin) factor = dear;
      if (factor == near_factors_[i]) continue;
      near_factors_[i] = factor;
      changes.push_back({{column, row}, cost_at(i)});
    }
  }
  if (changes.empty()) return;
  planner_.change_costs(changes);
  is_settled_ = false;
}

void RoutePlanner::prefer(std::span<const Point2> way) {
  constexpr double kShoulder = 1.0;  // [m] over which the floor beside the lane becomes dear
  lane_factors_.clear();
  if (!way.empty()) {
    const GridFrame& frame = planner_.frame();
    std::vector<bool> on_way(frame.size(), false);
    for (std::size_t i = 0; i < way.size(); ++i) {
      const Point2 from = way[i == 0 ? 0 : i - 1];
      const int pieces = std::max(1, static_cast<int>(std::ceil(2.0 * distance(from, way[i]) / frame.resolution)));
      for (int piece = 1; piece <= pieces; ++piece) {
        const CellIndex cell = frame.cell_at(from + (static_cast<double>(piece) / pieces) * (way[i] - from));
        if (frame.holds(cell)) on_way[frame.index(cell)] = true;
      }
    }
    for (const float off : distance_transform(frame, on_way)) {
      const double beside = std::clamp((static_cast<double>(off) - 0.5 * params_.lane_width) / kShoulder, 0.0, 1.0);
      lane_factors_.push_back(static_cast<float>(1.0 + params_.lane_cost * beside));
    }
  }
  apply_costs();
}

float RoutePlanner::cost_at(std::size_t cell) const {
  const float beside = lane_factors_.empty() ? 1.0F : lane_factors_[cell];
  return static_costs_[cell] * beside * near_factors_[cell];
}

void RoutePlanner::apply_costs() {
  std::vector<float> costs(static_costs_.size());
  for (std::size_t i = 0; i < costs.size(); ++i) costs[i] = cost_at(i);
  planner_.set_costs(costs);
  is_settled_ = false;
}

void RoutePlanner::set_goals(std::span<const Point2> goals, double tolerance) {
  const GridFrame& frame = planner_.frame();
  std::vector<ValueIteration::Goal> cells;
  const int reach = static_cast<int>(std::ceil(tolerance / frame.resolution));
  for (const Point2& goal : goals) {
    const CellIndex centre = frame.cell_at(goal);
    for (int row = centre.row - reach; row <= centre.row + reach; ++row) {
      for (int column = centre.column - reach; column <= centre.column + reach; ++column) {
        const CellIndex cell{column, row};
        if (!frame.holds(cell)) continue;
        const double off = distance(frame.centre(cell), goal);
        if (cell == centre || (off <= tolerance && planner_.cost(cell) < ValueIteration::kClosed)) {
          cells.push_back({cell, static_cast<float>(off)});
        }
      }
    }
  }
  planner_.set_goals(cells);
  is_settled_ = false;
  held_.clear();
}

bool RoutePlanner::settle(Point2 start, int most_visits) {
  // Where the way begins may be found only when values are there.
  const auto cell = nearest_open(start, kNear);
  if (!cell) return iterate(most_visits);
  is_settled_ = planner_.settle(*cell, most_visits) && nearest_open(start, kNear) == cell;
  return is_settled_;
}

bool RoutePlanner::is_closed(Point2 in_map) const {
  const CellIndex cell = planner_.frame().cell_at(in_map);
  return !planner_.frame().holds(cell) || static_costs_[planner_.frame().index(cell)] == ValueIteration::kClosed;
}

std::optional<CellIndex> RoutePlanner::nearest_open(Point2 in_map, double within) const {
  const GridFrame& frame = planner_.frame();
  const CellIndex centre = frame.cell_at(in_map);
  const int reach = static_cast<int>(std::ceil(within / frame.resolution));
  std::optional<CellIndex> best;
  double least = std::numeric_limits<double>::infinity();
  for (int row = centre.row - reach; row <= centre.row + reach; ++row) {
    for (int column = centre.column - reach; column <= centre.column + reach; ++column) {
      const CellIndex cell{column, row};
      if (!frame.holds(cell) || planner_.value(cell) == ValueIteration::kClosed) continue;
      if (planner_.cost(cell) == ValueIteration::kClosed) continue;
      const double off = distance(frame.centre(cell), in_map);
      if (off < least) {
        least = off;
        best = cell;
      }
    }
  }
  return best;
}

double RoutePlanner::cost_from(Point2 start) const {
  const auto cell = nearest_open(start, kNear);
  return cell ? static_cast<double>(planner_.value(*cell)) : std::numeric_limits<double>::infinity();
}

/// Cost of the straight line between the points; infinity where a cell on it is dearer than `most_cost`.
double RoutePlanner::line_cost(Point2 from, Point2 to, float most_cost) const {
  const double length = distance(from, to);
  const int steps = std::max(1, static_cast<int>(std::ceil(length / (0.4 * planner_.frame().resolution))));
  double sum = 0.0;
  for (int i = 0; i <= steps; ++i) {
    const CellIndex cell = planner_.frame().cell_at(from + (static_cast<double>(i) / steps) * (to - from));
    if (!planner_.frame().holds(cell) || planner_.cost(cell) > most_cost)
      return std::numeric_limits<double>::infinity();
    sum += (i == 0 || i == steps ? 0.5 : 1.0) * static_cast<double>(planner_.cost(cell));
  }
  return sum / steps * length / planner_.frame().resolution;
}

/// Where on the way held `start` is; its end if it is not near.
std::size_t RoutePlanner::nearest_held(Point2 start) const {
  std::size_t best = held_.size();
  double least = kAlong;
  for (std::size_t i = 0; i < held_.size(); ++i) {
    const double off = distance(planner_.frame().centre(held_[i]), start);
    if (off > least) continue;
    least = off;
    best = i;
  }
  return best;
}

/// Of a way that ends at a goal, as its values would be. `unmoved` by whom it passes at a distance: only who stands in
/// the way costs anything then.
double RoutePlanner::cost_of(std::span<const CellIndex> way, bool unmoved) const {
  auto cost = static_cast<double>(planner_.value(way.back()));
  for (std::size_t i = 1; i < way.size(); ++i) {
    const bool aslant = way[i].column != way[i - 1].column && way[i].row != way[i - 1].row;
    const float near = near_factors_.empty() ? 1.0F : near_factors_[planner_.frame().index(way[i])];
    const float counts = unmoved && near < static_cast<float>(params_.obstacle_cost) ? near : 1.0F;
    cost += static_cast<double>(planner_.cost(way[i]) / counts) * (aslant ? std::numbers::sqrt2 : 1.0);
  }
  return cost;
}

/// Indices of the cells within `aside` of the way held as it was when it was chosen: steps aside do not add up. Each
/// finds itself in the list by `places_`.
std::vector<std::size_t> RoutePlanner::list_beside_chosen() {
  const GridFrame& frame = planner_.frame();
  const int reach = static_cast<int>(params_.aside / frame.resolution);
  places_.resize(frame.size(), kNowhere);
  std::vector<std::size_t> cells;
  for (const CellIndex& at : chosen_) {
    for (int row = -reach; row <= reach; ++row) {
      for (int column = -reach; column <= reach; ++column) {
        const CellIndex cell{at.column + column, at.row + row};
        if (column * column + row * row > reach * reach || !frame.holds(cell)) continue;
        std::int32_t& place = places_[frame.index(cell)];
        if (place != kNowhere) continue;
        place = static_cast<std::int32_t>(cells.size());
        cells.push_back(frame.index(cell));
      }
    }
  }
  return cells;
}

/// The best way from `start` to a goal beside the way that was chosen, by Dijkstra's algorithm; empty: none.
std::vector<CellIndex> RoutePlanner::best_beside_chosen(CellIndex start) {
  using Entry = std::pair<double, std::size_t>;
  const GridFrame& frame = planner_.frame();
  const auto cell_of = [&](std::size_t i) {
    return CellIndex{static_cast<int>(i) % frame.columns, static_cast<int>(i) / frame.columns};
  };
  const std::vector<std::size_t> cells = list_beside_chosen();
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  std::vector<double> costs(cells.size(), std::numeric_limits<double>::infinity());
  std::vector<std::size_t> next(cells.size(), frame.size());
  const auto place_of = [&](std::size_t cell) { return static_cast<std::size_t>(places_[cell]); };
  const auto offer = [&](std::size_t to, double cost, std::size_t from) {
    if (places_[to] == kNowhere || !(cost < costs[place_of(to)])) return;
    costs[place_of(to)] = cost;
    next[place_of(to)] = from;
    queue.emplace(cost, to);
  };
  for (const std::size_t i : cells)
    if (planner_.is_goal(cell_of(i))) offer(i, static_cast<double>(planner_.value(cell_of(i))), i);
  while (!queue.empty() && queue.top().second != frame.index(start)) {
    const auto [cost, at] = queue.top();
    queue.pop();
    if (cost > costs[place_of(at)]) continue;
    const auto step = static_cast<double>(planner_.cost(cell_of(at)));
    for (int row = -1; row <= 1; ++row) {
      for (int column = -1; column <= 1; ++column) {
        const CellIndex beside{cell_of(at).column + column, cell_of(at).row + row};
        const double length = row != 0 && column != 0 ? std::numbers::sqrt2 : 1.0;
        if (frame.holds(beside)) offer(frame.index(beside), cost + length * step, at);
      }
    }
  }
  std::vector<CellIndex> way;
  if (!queue.empty()) {
    std::size_t at = frame.index(start);
    for (; next[place_of(at)] != at; at = next[place_of(at)]) way.push_back(cell_of(at));
    way.push_back(cell_of(at));
  }
  for (const std::size_t cell : cells) places_[cell] = kNowhere;
  return way;
}

std::vector<CellIndex> RoutePlanner::cells_from(Point2 start) const {
  if (const std::size_t first = nearest_held(start); first < held_.size())
    return {held_.begin() + static_cast<std::ptrdiff_t>(first), held_.end()};
  const auto cell = nearest_open(start, kNear);
  if (!cell) return {};
  std::vector<CellIndex> cells = planner_.descend(*cell);
  if (cells.empty() && !planner_.is_goal(*cell)) return {};
  cells.insert(cells.begin(), *cell);
  return cells;
}

void RoutePlanner::hold_way(Point2 start) {
  const auto cell = nearest_open(start, kNear);
  const std::size_t first = nearest_held(start);
  if (cell && first < held_.size()) {
    held_.erase(held_.begin(), held_.begin() + static_cast<std::ptrdiff_t>(first));
    const double most = (1.0 + params_.switch_gain) * static_cast<double>(planner_.value(*cell));
    if (cost_of(held_, false) <= most + planner_.frame().resolution) return;
    auto aside = best_beside_chosen(*cell);
    if (!aside.empty() && cost_of(aside, true) <= most + params_.aside) {
      held_ = std::move(aside);
      return;
    }
  }
  held_.clear();
  if (cell) held_ = cells_from(start);
  chosen_ = held_;
}

std::vector<Point2> RoutePlanner::way(Point2 start) const {
  std::vector<Point2> corners;
  for (const CellIndex& cell : cells_from(start)) corners.push_back(planner_.frame().centre(cell));
  if (corners.empty()) return {};

  // Shortcuts over floor that is nowhere dearer than the way and costs no more, at most 2 m long: the staircase of the
  // grid becomes straight, and the clearance that the costs bought stays. Where the way begins beside somebody, all of
  // it is dear there: it is the sum that keeps the shortcut from leading through them.
  std::vector<Point2> way;
  std::size_t at = 0;
  way.push_back(corners[0]);
  const auto cost_at_corner = [&](std::size_t i) { return planner_.cost(planner_.frame().cell_at(corners[i])); };
  while (at + 1 < corners.size()) {
    std::size_t next = at + 1;
    float dearest = cost_at_corner(at);
    double cost = 0.0;
    for (std::size_t far = at + 1; far < corners.size() && distance(corners[at], corners[far]) <= 2.0; ++far) {
      dearest = std::max(dearest, cost_at_corner(far));
      cost += 0.5 * static_cast<double>(cost_at_corner(far - 1) + cost_at_corner(far)) *
              distance(corners[far - 1], corners[far]) / planner_.frame().resolution;
      constexpr double kRounding = 1.001;
      if (line_cost(corners[at], corners[far], dearest) <= kRounding * cost) next = far;
    }
    const double length = distance(corners[at], corners[next]);
    const int pieces = std::max(1, static_cast<int>(std::lround(length / 0.2)));
    for (int i = 1; i <= pieces; ++i) {
      way.push_back(corners[at] + (static_cast<double>(i) / pieces) * (corners[next] - corners[at]));
    }
    at = next;
  }
  return way;
}

}  // namespace docent::planning
