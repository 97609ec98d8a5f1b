#include "docent/task_control/tour_scheduler/route.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>

namespace docent::task_control {
namespace {

// What cannot be reached is dear but comparable, so that the others still come in a good order.
// prolog/travel.pl orders by the same two: no_way, least_gain.
constexpr double kNoWay = 1e6;  // [m]
constexpr double kGain = 1e-9;  // [m] a route that is shorter by less is as long
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// All places of all stops in one row, those of a stop beside each other.
struct Places {
  std::vector<RouteStop> name;
  std::vector<std::size_t> first;  ///< of each stop; one more at the end
  std::vector<double> from_start;
  std::vector<double> between;  ///< [from * size() + to]

  [[nodiscard]] std::size_t size() const { return name.size(); }
  [[nodiscard]] std::size_t stops() const { return first.size() - 1; }
  [[nodiscard]] double way(std::size_t from, std::size_t to) const { return between[from * size() + to]; }
};

Places places_of(Point2 start, std::span<const StopPlaces> stops, const TravelDistance& travel) {
  Places places;
  std::vector<Point2> points;
  for (std::size_t stop = 0; stop < stops.size(); ++stop) {
    places.first.push_back(points.size());
    for (std::size_t place = 0; place < stops[stop].size(); ++place) {
      places.name.push_back({stop, place});
      points.push_back(stops[stop][place]);
    }
  }
  places.first.push_back(points.size());
  for (const Point2 to : points) places.from_start.push_back(std::min(travel(start, to), kNoWay));
  for (const Point2 from : points) {
    for (const Point2 to : points) places.between.push_back(std::min(travel(from, to), kNoWay));
  }
  return places;
}

std::vector<RouteStop> exact_route(const Places& places) {
  const std::size_t n = places.stops();
  const std::size_t count = places.size();
  const std::size_t sets = std::size_t{1} << n;
  // best[set][last]: the shortest way from the start through all stops of `set` that ends in the place `last`.
  std::vector<double> best(sets * count, kInfinity);
  std::vector<std::uint8_t> before(sets * count, 0);
  static_assert(kExactPlaces <= 256);
  for (std::size_t i = 0; i < count; ++i)
    best[(std::size_t{1} << places.name[i].stop) * count + i] = places.from_start[i];
  for (std::size_t set = 1; set < sets; ++set) {
    for (std::size_t last = 0; last < count; ++last) {
      const double so_far = best[set * count + last];
      if (so_far == kInfinity) continue;
      const double* const ways = &places.between[last * count];
      for (std::size_t stop = 0; stop < n; ++stop) {
        const std::size_t bit = std::size_t{1} << stop;
        if ((set & bit) != 0) continue;
        const std::size_t row = (set | bit) * count;
        for (std::size_t next = places.first[stop]; next < places.first[stop + 1]; ++next) {
          const double length = so_far + ways[next];
          if (length >= best[row + next] - kGain) continue;
          best[row + next] = length;
          before[row + next] = static_cast<std::uint8_t>(last);
        }
      }
    }
  }
  std::size_t set = sets - 1;
  std::size_t last = 0;
  for (std::size_t i = 1; i < count; ++i) {
    if (best[set * count + i] < best[set * count + last] - kGain) last = i;
  }
  std::vector<RouteStop> route;
  while (set != 0) {
    route.push_back(places.name[last]);
    const std::size_t previous = before[set * count + last];
    set &= ~(std::size_t{1} << places.name[last].stop);
    last = previous;
  }
  std::reverse(route.begin(), route.end());
  return route;
}

/// The stops in this order, each at the place that makes the whole shortest; its length.
double best_places(const Places& places, std::span<const std::size_t> order, std::vector<RouteStop>* route) {
  if (route == nullptr && places.size() == places.stops()) {  // one place each: there is nothing to choose
    double sum = order.empty() ? 0.0 : places.from_start[order.front()];
    for (std::size_t k = 1; k < order.size(); ++k) sum += places.way(order[k - 1], order[k]);
    return sum;
  }
  std::vector<std::vector<std::size_t>> before;  // for each stop of the order and each of its places
  std::vector<double> lengths;
  std::vector<double> next;
  std::vector<std::size_t> from;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const std::size_t first = places.first[order[k]];
    const std::size_t end = places.first[order[k] + 1];
    next.assign(end - first, kInfinity);
    from.assign(end - first, 0);
    for (std::size_t i = first; i < end; ++i) {
      if (k == 0) next[i - first] = places.from_start[i];
      for (std::size_t j = 0; k > 0 && j < lengths.size(); ++j) {
        const double length = lengths[j] + places.way(places.first[order[k - 1]] + j, i);
        if (length >= next[i - first] - kGain) continue;
        next[i - first] = length;
        from[i - first] = j;
      }
    }
    std::swap(lengths, next);
    if (route != nullptr) before.push_back(from);
  }
  if (lengths.empty()) return 0.0;
  std::size_t place = 0;
  for (std::size_t i = 1; i < lengths.size(); ++i) {
    if (lengths[i] < lengths[place] - kGain) place = i;
  }
  const double length = lengths[place];
  if (route == nullptr) return length;
  for (std::size_t k = order.size(); k-- > 0; place = before[k][place]) route->push_back({order[k], place});
  std::reverse(route->begin(), route->end());
  return length;
}

std::vector<std::size_t> nearest_neighbour_order(const Places& places) {
  std::vector<std::size_t> order;
  std::vector<bool> used(places.stops(), false);
  std::size_t at = places.size();
  while (order.size() < places.stops()) {
    std::size_t nearest = places.size();
    const auto way_to = [&](std::size_t i) { return at == places.size() ? places.from_start[i] : places.way(at, i); };
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (used[places.name[i].stop]) continue;
      if (nearest == places.size() || way_to(i) < way_to(nearest) - kGain) nearest = i;
    }
    at = nearest;
    used[places.name[at].stop] = true;
    order.push_back(places.name[at].stop);
  }
  return order;
}

/// Reverses or moves one stretch if that makes the way shorter.
bool improve(const Places& places, std::vector<std::size_t>& order) {
  const double length = best_places(places, order, nullptr);
  for (std::size_t first = 0; first < order.size(); ++first) {
    for (std::size_t last = first + 1; last < order.size(); ++last) {
      auto reversed = order;
      const auto begin = static_cast<std::ptrdiff_t>(first);
      const auto end = static_cast<std::ptrdiff_t>(last) + 1;
      std::reverse(reversed.begin() + begin, reversed.begin() + end);
      auto later = order;
      std::rotate(later.begin() + begin, later.begin() + begin + 1, later.begin() + end);
      auto sooner = order;
      std::rotate(sooner.begin() + begin, sooner.begin() + end - 1, sooner.begin() + end);
      for (auto* const candidate : {&reversed, &later, &sooner}) {
        if (best_places(places, *candidate, nullptr) >= length - kGain) continue;
        order = std::move(*candidate);
        return true;
      }
    }
  }
  return false;
}

}  // namespace

double route_length(Point2 start, std::span<const StopPlaces> stops, std::span<const RouteStop> route,
                    const TravelDistance& travel) {
  double sum = 0.0;
  Point2 at = start;
  for (const RouteStop& stop : route) {
    const Point2 place = stops[stop.stop][stop.place];
    sum += travel(at, place);
    at = place;
  }
  return sum;
}

std::vector<RouteStop> shortest_route(Point2 start, std::span<const StopPlaces> stops, const TravelDistance& travel) {
  if (stops.empty()) return {};
  const Places places = places_of(start, stops, travel);
  if (places.stops() <= kExactStops && places.size() <= kExactPlaces) return exact_route(places);
  auto order = nearest_neighbour_order(places);
  while (improve(places, order)) {
  }
  std::vector<RouteStop> route;
  (void)best_places(places, order, &route);
  return route;
}

}  // namespace docent::task_control
