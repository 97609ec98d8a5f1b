#include "docent/task_control/tour_scheduler/route.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "docent/base/random.h"

namespace docent::task_control {
namespace {

Point2 any_point(Rng& rng) { return {rng.uniform(0, 30), rng.uniform(0, 30)}; }

/// Stops with `least` to `most` places each.
std::vector<StopPlaces> any_stops(Rng& rng, std::size_t count, int least = 1, int most = 1) {
  std::vector<StopPlaces> stops(count);
  for (StopPlaces& places : stops) {
    for (auto n = rng.integer(least, most); n > 0; --n) places.push_back(any_point(rng));
  }
  return stops;
}

std::vector<std::size_t> order_of(const std::vector<RouteStop>& route) {
  std::vector<std::size_t> order;
  for (const RouteStop& stop : route) order.push_back(stop.stop);
  return order;
}

std::vector<std::size_t> counting(std::size_t count) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  return order;
}

/// The shortest of all orders with all choices of places: the slow twin.
double shortest_of_all(Point2 start, const std::vector<StopPlaces>& stops) {
  auto order = counting(stops.size());
  double best = 1e9;
  do {
    std::vector<RouteStop> route;
    for (const std::size_t stop : order) route.push_back({stop, 0});
    for (bool is_over = false; !is_over;) {
      best = std::min(best, route_length(start, stops, route, straight_distance()));
      is_over = true;
      for (RouteStop& stop : route) {  // counts through the places
        if (++stop.place < stops[stop.stop].size()) {
          is_over = false;
          break;
        }
        stop.place = 0;
      }
    }
  } while (std::next_permutation(order.begin(), order.end()));
  return best;
}

TEST(Route, GoesAlongALine) {
  const std::vector<StopPlaces> stops{{{9, 0}}, {{1, 0}}, {{5, 0}}};
  EXPECT_EQ(order_of(shortest_route({0, 0}, stops, straight_distance())), (std::vector<std::size_t>{1, 2, 0}));
  EXPECT_TRUE(shortest_route({0, 0}, {}, straight_distance()).empty());
}

TEST(Route, IsNotFooledByTheNearestFirst) {
  // From 0 the nearest is +1, but going to -1.2 first and then right for good is shorter.
  const std::vector<StopPlaces> stops{{{1, 0}}, {{-1.2, 0}}, {{10, 0}}};
  EXPECT_EQ(order_of(shortest_route({0, 0}, stops, straight_distance())), (std::vector<std::size_t>{1, 0, 2}));
}

TEST(Route, SeesAnExhibitFromTheSideThatIsOnItsWay) {
  const std::vector<StopPlaces> stops{{{5, 3}, {5, 0}, {5, -3}}, {{10, 0}}};
  EXPECT_EQ(shortest_route({0, 0}, stops, straight_distance()), (std::vector<RouteStop>{{0, 1}, {1, 0}}));
  EXPECT_EQ(shortest_route({5, 9}, stops, straight_distance()), (std::vector<RouteStop>{{0, 0}, {1, 0}}));
}

TEST(Route, IsAsShortAsTheBestOfAllOrdersAndPlaces) {
  for (std::uint64_t seed = 0; seed < 90; ++seed) {
    Rng rng{seed};
    const Point2 start = any_point(rng);
    const bool has_groups = seed % 3 == 0;
    const auto stops = any_stops(rng, 1 + seed % (has_groups ? 5 : 7), 1, has_groups ? 3 : 1);
    const auto route = shortest_route(start, stops, straight_distance());
    auto order = order_of(route);
    EXPECT_NEAR(route_length(start, stops, route, straight_distance()), shortest_of_all(start, stops), 1e-6)
        << "seed " << seed;
    std::sort(order.begin(), order.end());
    EXPECT_EQ(order, counting(stops.size())) << "seed " << seed;
  }
}

// Fifteen stops are too many for all orders. Their route is the best if each of its parts is the best way through the
// part's stops to the part's end: checked with parts of seven.
TEST(Route, PartsOfALongRouteAreTheBestToo) {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    Rng rng{seed};
    const Point2 start = any_point(rng);
    const auto stops = any_stops(rng, kExactStops, 1, 3);
    const auto route = shortest_route(start, stops, straight_distance());
    ASSERT_EQ(route.size(), stops.size());
    const auto place = [&](std::size_t i) { return stops[route[i].stop][route[i].place]; };
    for (std::size_t first = 0; first + 7 < route.size(); ++first) {
      std::vector<std::size_t> inner{first + 1, first + 2, first + 3, first + 4, first + 5, first + 6};
      double as_routed = 0.0;
      for (std::size_t i = first; i < first + 7; ++i) as_routed += distance(place(i), place(i + 1));
      do {
        double length = distance(place(first), place(inner.front())) + distance(place(inner.back()), place(first + 7));
        for (std::size_t i = 1; i < inner.size(); ++i) length += distance(place(inner[i - 1]), place(inner[i]));
        EXPECT_GE(length, as_routed - 1e-6) << "seed " << seed;
      } while (std::next_permutation(inner.begin(), inner.end()));
    }
  }
}

TEST(Route, ManyStopsAreAPermutationAndNoLongerThanNearestFirst) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Rng rng{seed};
    const auto stops = any_stops(rng, 25, 1, seed % 2 == 0 ? 1 : 2);
    const auto route = shortest_route({0, 0}, stops, straight_distance());
    const double length = route_length({0, 0}, stops, route, straight_distance());
    double nearest_first = 0.0;
    auto left = stops;
    Point2 at{0, 0};
    while (!left.empty()) {
      std::size_t nearest = 0;
      Point2 place = left.front().front();
      for (std::size_t i = 0; i < left.size(); ++i) {
        for (const Point2 other : left[i]) {
          if (distance(at, other) >= distance(at, place)) continue;
          nearest = i;
          place = other;
        }
      }
      nearest_first += distance(at, place);
      at = place;
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(nearest));
    }
    EXPECT_LE(length, nearest_first + 1e-9) << "seed " << seed;
    auto order = order_of(route);
    std::sort(order.begin(), order.end());
    EXPECT_EQ(order, counting(stops.size()));
  }
}

TEST(Route, WhatCannotBeReachedComesLast) {
  const TravelDistance walled = [](Point2 from, Point2 to) {
    return (from.x < 5) == (to.x < 5) ? distance(from, to) : std::numeric_limits<double>::infinity();
  };
  const std::vector<StopPlaces> stops{{{6, 0}}, {{4, 0}}, {{1, 0}}};
  EXPECT_EQ(order_of(shortest_route({0, 0}, stops, walled)), (std::vector<std::size_t>{2, 1, 0}));
}

}  // namespace
}  // namespace docent::task_control
