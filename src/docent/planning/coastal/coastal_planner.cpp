#include "docent/planning/coastal/coastal_planner.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>

namespace docent::planning {
namespace {

constexpr float kClosed = std::numeric_limits<float>::infinity();
constexpr float kSame = 1e-3F;   // [m] smaller changes of a value are none
constexpr double kNearby = 0.8;  // [m] a robot that stands on a closed cell begins at the nearest open one

}  // namespace

Result<void> CoastalParams::validate() const {
  if (!(weight >= 0.0 && weight < 1000.0)) return fail("weight must be in 0..1000");
  if (!(goal_way >= 0.0)) return fail("goal_way must be >= 0");
  if (!(least_deviation > 0.0)) return fail("least_deviation must be > 0");
  if (!(largest_deviation > least_deviation)) return fail("largest_deviation must be > least_deviation");
  if (levels < 2 || levels > 200) return fail("levels must be in 2..200");
  if (auto valid = places.validate(); !valid) return valid;
  return uncertainty.validate();
}

CoastalFloor CoastalFloor::of(const GridFrame& fine, std::span<const float> costs, int factor) {
  CoastalFloor floor;
  floor.frame = {(fine.columns + factor - 1) / factor, (fine.rows + factor - 1) / factor, fine.resolution * factor,
                 fine.origin};
  floor.costs.assign(floor.frame.size(), kClosed);
  for (int row = 0; row < fine.rows; ++row) {
    for (int column = 0; column < fine.columns; ++column) {
      float& cost = floor.costs[floor.frame.index({column / factor, row / factor})];
      cost = std::min(cost, static_cast<float>(factor) * costs[fine.index({column, row})]);
    }
  }
  return floor;
}

CoastalPlanner::CoastalPlanner(const OccupancyGrid& map, CoastalFloor floor, const CoastalParams& params)
    : params_{params},
      floor_{std::move(floor)},
      information_{information_map(map, floor_.frame, floor_.costs, params.places)},
      uncertainty_{params.uncertainty},
      eigenvalues_(floor_.frame.size()),
      values_(floor_.frame.size() * static_cast<std::size_t>(params.levels), kClosed),
      is_goal_(floor_.frame.size(), false),
      is_stale_(floor_.frame.size(), false) {
  std::size_t at = 0;
  for (int rows = -1; rows <= 1; ++rows) {
    for (int columns = -1; columns <= 1; ++columns) {
      if (rows == 0 && columns == 0) continue;
      steps_[at++] = {columns, rows, rows != 0 && columns != 0};
    }
  }
  for (std::size_t cell = 0; cell < eigenvalues_.size(); ++cell)
    eigenvalues_[cell] = information_.places[cell].eigenvalues(params_.uncertainty.heading_scale);
  foretell();
}

double CoastalPlanner::level_of(double variance) const {
  const double span = std::log(params_.largest_deviation / params_.least_deviation);
  const double over = 0.5 * std::log(std::max(variance, 1e-12)) - std::log(params_.least_deviation);
  return std::clamp(over / span, 0.0, 1.0) * (params_.levels - 1);
}

double CoastalPlanner::variance_at(double level) const {
  const double span = std::log(params_.largest_deviation / params_.least_deviation);
  const double deviation = params_.least_deviation * std::exp(span * level / (params_.levels - 1));
  return deviation * deviation;
}

Point2 CoastalPlanner::centre_of(std::size_t cell) const {
  const auto columns = static_cast<std::size_t>(floor_.frame.columns);
  return floor_.frame.centre({static_cast<int>(cell % columns), static_cast<int>(cell / columns)});
}

double CoastalPlanner::cells_of(const Step& step) { return step.is_diagonal ? std::numbers::sqrt2 : 1.0; }

double CoastalPlanner::step_length(const Step& step) const { return floor_.frame.resolution * cells_of(step); }

template <class Visit>
void CoastalPlanner::for_neighbours(std::size_t cell, Visit visit) const {
  const GridFrame& frame = floor_.frame;
  const auto columns = static_cast<std::size_t>(frame.columns);
  const auto column = static_cast<int>(cell % columns);
  const auto row = static_cast<int>(cell / columns);
  for (const Step& step : steps_) {
    const CellIndex next{column + step.columns, row + step.rows};
    if (!frame.holds(next) || floor_.costs[frame.index(next)] == kClosed) continue;
    visit(frame.index(next), step);
  }
}

/// The levels to which a step into each open cell leads; every step into it is one of two lengths.
void CoastalPlanner::foretell() {
  const auto levels = static_cast<std::size_t>(params_.levels);
  open_index_.assign(floor_.frame.size(), 0);
  for (std::size_t cell = 0; cell < floor_.frame.size(); ++cell) {
    if (floor_.costs[cell] == kClosed) continue;
    open_index_[cell] = static_cast<std::uint32_t>(after_.size() / (2 * levels));
    for (const bool is_diagonal : {false, true}) {
      const double length = step_length({0, 0, is_diagonal});
      for (std::size_t level = 0; level < levels; ++level) {
        const double variance = variance_at(static_cast<double>(level));
        after_.push_back(static_cast<float>(level_of(uncertainty_.after(variance, eigenvalues_[cell], length))));
      }
    }
  }
}

const float* CoastalPlanner::levels_after(std::size_t to, bool is_diagonal) const {
  const auto levels = static_cast<std::size_t>(params_.levels);
  return after_.data() + (2 * static_cast<std::size_t>(open_index_[to]) + (is_diagonal ? 1 : 0)) * levels;
}

float CoastalPlanner::value_at(std::size_t cell, double level) const {
  const auto levels = static_cast<std::size_t>(params_.levels);
  const auto low = std::min(static_cast<std::size_t>(level), levels - 2);
  const auto share = static_cast<float>(level - static_cast<double>(low));
  const float* values = values_.data() + cell * levels + low;
  return values[0] == kClosed ? kClosed : values[0] + share * (values[1] - values[0]);
}

float CoastalPlanner::step_cost(std::size_t to, const Step& step, double level_after) const {
  // One level is so many nats: the entropy of the pose is three halves of the logarithm of its variance.
  const double nats_a_level =
      3.0 * std::log(params_.largest_deviation / params_.least_deviation) / (params_.levels - 1);
  const double floor = static_cast<double>(floor_.costs[to]) * cells_of(step);
  return static_cast<float>(floor + params_.weight * nats_a_level * level_after * step_length(step));
}

void CoastalPlanner::set_goal(Point2 goal, double tolerance) {
  const GridFrame& frame = floor_.frame;
  const auto levels = static_cast<std::size_t>(params_.levels);
  std::fill(values_.begin(), values_.end(), kClosed);
  is_goal_.assign(frame.size(), false);
  is_stale_.assign(frame.size(), false);
  forward_ = true;
  is_settled_ = false;
  const auto nearest = nearest_open(goal);
  const double nats = 3.0 * std::log(params_.largest_deviation / params_.least_deviation);
  for (std::size_t cell = 0; cell < frame.size(); ++cell) {
    const double off = distance(centre_of(cell), goal);
    if (cell != nearest && (off > tolerance || floor_.costs[cell] == kClosed)) continue;
    is_goal_[cell] = true;
    for (std::size_t level = 0; level < levels; ++level) {
      const double over = nats * static_cast<double>(level) / static_cast<double>(levels - 1);
      values_[cell * levels + level] = static_cast<float>(off + params_.weight * params_.goal_way * over);
    }
  }
  order_cells();
}

/// By the cost of the shortest way (Dijkstra's algorithm): values spread in this order.
void CoastalPlanner::order_cells() {
  using Entry = std::pair<float, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  std::vector<float> shortest(floor_.frame.size(), kClosed);
  for (std::size_t cell = 0; cell < shortest.size(); ++cell) {
    if (!is_goal_[cell]) continue;
    shortest[cell] = 0.0F;
    queue.emplace(0.0F, static_cast<std::uint32_t>(cell));
  }
  order_.clear();
  while (!queue.empty()) {
    const auto [cost, cell] = queue.top();
    queue.pop();
    if (cost > shortest[cell]) continue;
    order_.push_back(cell);
    is_stale_[cell] = !is_goal_[cell];
    for_neighbours(cell, [&, cost = cost, cell = cell](std::size_t next, const Step& step) {
      const float through = cost + floor_.costs[cell] * static_cast<float>(cells_of(step));
      if (through >= shortest[next]) return;
      shortest[next] = through;
      queue.emplace(through, static_cast<std::uint32_t>(next));
    });
  }
}

/// One cell, all levels. @returns true when a value fell.
bool CoastalPlanner::relax(std::size_t cell) {
  const auto levels = static_cast<std::size_t>(params_.levels);
  float* values = values_.data() + cell * levels;
  bool fell = false;
  for_neighbours(cell, [&](std::size_t next, const Step& step) {
    if (values_[next * levels] == kClosed) return;
    const float* after = levels_after(next, step.is_diagonal);
    const float base = step_cost(next, step, 0.0);
    const float a_level = step_cost(next, step, 1.0) - base;
    for (std::size_t level = 0; level < levels; ++level) {
      const float there = after[level];
      const auto low = std::min(static_cast<std::size_t>(there), levels - 2);
      const float share = there - static_cast<float>(low);
      const float* beyond = values_.data() + next * levels + low;
      const float through = base + a_level * there + beyond[0] + share * (beyond[1] - beyond[0]);
      if (through >= values[level]) continue;
      fell = fell || through < values[level] - kSame;
      values[level] = through;
    }
  });
  return fell;
}

bool CoastalPlanner::iterate(int most_sweeps) {
  for (int sweep = 0; sweep < most_sweeps && !is_settled_; ++sweep) {
    bool changed = false;
    const auto visit = [&](std::uint32_t cell) {
      if (!is_stale_[cell]) return;
      is_stale_[cell] = false;
      if (!relax(cell)) return;
      changed = true;
      for_neighbours(cell, [&](std::size_t next, const Step&) { is_stale_[next] = !is_goal_[next]; });
    };
    // Values spread away from the goal; where a better informed way first leads away from it, towards it.
    if (forward_)
      std::for_each(order_.begin(), order_.end(), visit);
    else
      std::for_each(order_.rbegin(), order_.rend(), visit);
    forward_ = !forward_;
    is_settled_ = !changed;
  }
  return is_settled_;
}

std::optional<std::size_t> CoastalPlanner::nearest_open(Point2 in_map) const {
  const GridFrame& frame = floor_.frame;
  const CellIndex centre = frame.cell_at(in_map);
  const int reach = static_cast<int>(std::ceil(kNearby / frame.resolution));
  std::optional<std::size_t> best;
  double least = std::numeric_limits<double>::infinity();
  for (int row = centre.row - reach; row <= centre.row + reach; ++row) {
    for (int column = centre.column - reach; column <= centre.column + reach; ++column) {
      const CellIndex cell{column, row};
      if (!frame.holds(cell) || floor_.costs[frame.index(cell)] == kClosed) continue;
      const double off = distance(frame.centre(cell), in_map);
      if (off >= least) continue;
      least = off;
      best = frame.index(cell);
    }
  }
  return best;
}

double CoastalPlanner::value(Point2 in_map, double variance) const {
  const auto cell = nearest_open(in_map);
  return cell ? static_cast<double>(value_at(*cell, level_of(variance))) : std::numeric_limits<double>::infinity();
}

std::vector<Point2> CoastalPlanner::way(Point2 start, double variance) const {
  auto cell = nearest_open(start);
  if (!cell) return {};
  std::vector<Point2> way{centre_of(*cell)};
  std::vector<std::uint8_t> visits(floor_.frame.size(), 0);
  while (!is_goal_[*cell]) {
    // A robot may come past a place again, better informed; not again and again.
    if (++visits[*cell] > 3) return {};
    std::optional<std::size_t> best;
    float least = kClosed;
    double variance_there = variance;
    for_neighbours(*cell, [&](std::size_t next, const Step& step) {
      const double there = uncertainty_.after(variance, eigenvalues_[next], step_length(step));
      const double level = level_of(there);
      const float through = step_cost(next, step, level) + value_at(next, level);
      if (through >= least) return;
      least = through;
      best = next;
      variance_there = there;
    });
    if (!best) return {};
    cell = best;
    variance = variance_there;
    way.push_back(centre_of(*cell));
  }
  return way;
}

std::vector<double> CoastalPlanner::variances_along(Point2 start, std::span<const Point2> way, double variance) const {
  std::vector<double> variances;
  Point2 before = start;
  for (const Point2& point : way) {
    const CellIndex cell = floor_.frame.cell_at(point);
    const auto& eigenvalues =
        floor_.frame.holds(cell) ? eigenvalues_[floor_.frame.index(cell)] : std::array<double, 3>{};
    const double length = distance(before, point);
    if (length > 0.0) variance = uncertainty_.after(variance, eigenvalues, length);
    variances.push_back(variance);
    before = point;
  }
  return variances;
}

}  // namespace docent::planning
