#include "docent/task_control/tour_scheduler/route.h"

#include <algorithm>
#include <limits>

namespace docent::task_control {
namespace {

// What cannot be reached is dear but comparable, so that the others still come in a good order.
constexpr double kNoWay = 1e6;
constexpr double kGain = 1e-9;

struct Costs {
  std::vector<double> from_start;
  std::vector<std::vector<double>> between;

  [[nodiscard]] double length(const std::vector<std::size_t>& order) const {
    double sum = order.empty() ? 0.0 : from_start[order.front()];
    for (std::size_t i = 1; i < order.size(); ++i) sum += between[order[i - 1]][order[i]];
    return sum;
  }
};

Costs costs_of(Point2 start, std::span<const Point2> points, const TravelDistance& travel) {
  Costs costs;
  for (const Point2 to : points) costs.from_start.push_back(std::min(travel(start, to), kNoWay));
  for (const Point2 from : points) {
    auto& row = costs.between.emplace_back();
    for (const Point2 to : points) row.push_back(std::min(travel(from, to), kNoWay));
  }
  return costs;
}

std::vector<std::size_t> exact_order(const Costs& costs) {
  const std::size_t n = costs.from_start.size();
  const std::size_t sets = std::size_t{1} << n;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  // best[set][last]: the shortest way from the start through all of `set` that ends in `last`.
  std::vector<std::vector<double>> best(sets, std::vector<double>(n, kInfinity));
  std::vector<std::vector<std::size_t>> before(sets, std::vector<std::size_t>(n, n));
  for (std::size_t i = 0; i < n; ++i) best[std::size_t{1} << i][i] = costs.from_start[i];
  for (std::size_t set = 1; set < sets; ++set) {
    for (std::size_t last = 0; last < n; ++last) {
      if (best[set][last] == kInfinity) continue;
      for (std::size_t next = 0; next < n; ++next) {
        const std::size_t bit = std::size_t{1} << next;
        if ((set & bit) != 0) continue;
        const double length = best[set][last] + costs.between[last][next];
        if (length < best[set | bit][next] - kGain) {
          best[set | bit][next] = length;
          before[set | bit][next] = last;
        }
      }
    }
  }
  std::size_t set = sets - 1;
  std::size_t last = 0;
  for (std::size_t i = 1; i < n; ++i) {
    if (best[set][i] < best[set][last] - kGain) last = i;
  }
  std::vector<std::size_t> order;
  while (set != 0) {
    order.push_back(last);
    const std::size_t previous = before[set][last];
    set &= ~(std::size_t{1} << last);
    last = previous;
  }
  std::reverse(order.begin(), order.end());
  return order;
}

std::vector<std::size_t> nearest_neighbour_order(const Costs& costs) {
  const std::size_t n = costs.from_start.size();
  std::vector<std::size_t> order;
  std::vector<bool> used(n, false);
  while (order.size() < n) {
    const auto& row = order.empty() ? costs.from_start : costs.between[order.back()];
    std::size_t nearest = n;
    for (std::size_t i = 0; i < n; ++i) {
      if (!used[i] && (nearest == n || row[i] < row[nearest] - kGain)) nearest = i;
    }
    used[nearest] = true;
    order.push_back(nearest);
  }
  return order;
}

/// Reverses or moves one stretch if that makes the way shorter.
bool improve(const Costs& costs, std::vector<std::size_t>& order) {
  const double length = costs.length(order);
  for (std::size_t first = 0; first < order.size(); ++first) {
    for (std::size_t last = first + 1; last < order.size(); ++last) {
      auto reversed = order;
      std::reverse(reversed.begin() + static_cast<std::ptrdiff_t>(first),
                   reversed.begin() + static_cast<std::ptrdiff_t>(last) + 1);
      if (costs.length(reversed) < length - kGain) {
        order = std::move(reversed);
        return true;
      }
      auto moved = order;
      std::rotate(moved.begin() + static_cast<std::ptrdiff_t>(first),
                  moved.begin() + static_cast<std::ptrdiff_t>(first) + 1,
                  moved.begin() + static_cast<std::ptrdiff_t>(last) + 1);
      if (costs.length(moved) < length - kGain) {
        order = std::move(moved);
        return true;
      }
    }
  }
  return false;
}

}  // namespace

double route_length(Point2 start, std::span<const Point2> points, std::span<const std::size_t> order,
                    const TravelDistance& travel) {
  double sum = 0.0;
  Point2 at = start;
  for (const std::size_t index : order) {
    sum += travel(at, points[index]);
    at = points[index];
  }
  return sum;
}

std::vector<std::size_t> shortest_order(Point2 start, std::span<const Point2> points, const TravelDistance& travel) {
  if (points.empty()) return {};
  const Costs costs = costs_of(start, points, travel);
  if (points.size() <= kExactStops) return exact_order(costs);
  auto order = nearest_neighbour_order(costs);
  while (improve(costs, order)) {
  }
  return order;
}

}  // namespace docent::task_control
