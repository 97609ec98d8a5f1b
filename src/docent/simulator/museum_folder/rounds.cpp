#include "docent/simulator/museum_folder/rounds.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace docent::simulator {
namespace {

using Ways = std::span<const std::vector<double>>;

/// Home comes first, and each is followed by the nearest that is left.
std::vector<std::size_t> nearest_first(Ways ways) {
  std::vector<std::size_t> order(ways.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t i = 0; i + 1 < order.size(); ++i) {
    const std::vector<double>& from = ways[order[i]];
    const auto next = order.begin() + static_cast<std::ptrdiff_t>(i) + 1;
    std::iter_swap(
        next, std::min_element(next, order.end(), [&](std::size_t a, std::size_t b) { return from[a] < from[b]; }));
  }
  return order;
}

/// Turns stretches of the way round as long as that makes it shorter. Home stays the first.
void untangle(Ways ways, std::vector<std::size_t>& order) {
  constexpr double kWorthIt = 1e-6;  // [m]
  const auto at = [&](std::size_t i) { return order[i % order.size()]; };
  for (bool is_shorter = true; is_shorter;) {
    is_shorter = false;
    for (std::size_t i = 1; i < order.size(); ++i) {
      for (std::size_t k = i + 1; k < order.size(); ++k) {
        const double now = ways[at(i - 1)][at(i)] + ways[at(k)][at(k + 1)];
        const double turned = ways[at(i - 1)][at(k)] + ways[at(i)][at(k + 1)];
        if (turned > now - kWorthIt) continue;
        std::reverse(order.begin() + static_cast<std::ptrdiff_t>(i),
                     order.begin() + static_cast<std::ptrdiff_t>(k) + 1);
        is_shorter = true;
      }
    }
  }
}

}  // namespace

std::vector<std::vector<std::size_t>> rounds_of(Ways ways) {
  if (ways.size() < 2) return {};
  std::vector<std::size_t> order = nearest_first(ways);
  untangle(ways, order);
  const std::size_t stops = order.size() - 1;
  double length = 0.0;
  for (std::size_t i = 0; i < order.size(); ++i) length += ways[order[i]][order[(i + 1) % order.size()]];
  const auto by_length = static_cast<std::size_t>(std::ceil(length / kLongestRound));
  const std::size_t by_stops = (stops + kMostStopsOfARound - 1) / kMostStopsOfARound;
  const std::size_t count = std::max(by_stops, std::min(by_length, std::max<std::size_t>(stops / 2, 1)));
  std::vector<std::vector<std::size_t>> rounds(count);
  for (std::size_t i = 0; i < stops; ++i) rounds[i * count / stops].push_back(order[i + 1] - 1);
  return rounds;
}

}  // namespace docent::simulator
