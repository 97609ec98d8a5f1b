#include "docent/simulator/museum_folder/rounds.h"

#include <algorithm>
#include <numeric>

namespace docent::simulator {
namespace {

/// Each place is followed by the nearest that is left.
std::vector<std::size_t> nearest_first(Point2 home, std::span<const Point2> places) {
  std::vector<std::size_t> order(places.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  Point2 here = home;
  for (auto next = order.begin(); next != order.end(); ++next) {
    std::iter_swap(next, std::min_element(next, order.end(), [&](std::size_t a, std::size_t b) {
                     return distance(places[a], here) < distance(places[b], here);
                   }));
    here = places[*next];
  }
  return order;
}

/// Turns stretches of the way round as long as that makes it shorter.
void untangle(Point2 home, std::span<const Point2> places, std::vector<std::size_t>& order) {
  constexpr double kWorthIt = 1e-6;  // [m]
  const auto at = [&](std::size_t i) { return i == 0 || i > order.size() ? home : places[order[i - 1]]; };
  for (bool is_shorter = true; is_shorter;) {
    is_shorter = false;
    for (std::size_t i = 1; i <= order.size(); ++i) {
      for (std::size_t k = i + 1; k <= order.size(); ++k) {
        const double now = distance(at(i - 1), at(i)) + distance(at(k), at(k + 1));
        const double turned = distance(at(i - 1), at(k)) + distance(at(i), at(k + 1));
        if (turned > now - kWorthIt) continue;
        std::reverse(order.begin() + static_cast<std::ptrdiff_t>(i - 1),
                     order.begin() + static_cast<std::ptrdiff_t>(k));
        is_shorter = true;
      }
    }
  }
}

}  // namespace

std::vector<std::vector<std::size_t>> rounds_of(Point2 home, std::span<const Point2> places) {
  std::vector<std::size_t> order = nearest_first(home, places);
  untangle(home, places, order);
  const std::size_t count = (order.size() + kMostStopsOfARound - 1) / kMostStopsOfARound;
  std::vector<std::vector<std::size_t>> rounds(count);
  for (std::size_t i = 0; i < order.size(); ++i) rounds[i * count / order.size()].push_back(order[i]);
  return rounds;
}

}  // namespace docent::simulator
