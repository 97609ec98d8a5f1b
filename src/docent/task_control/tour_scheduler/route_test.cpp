#include "docent/task_control/tour_scheduler/route.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "docent/base/random.h"

namespace docent::task_control {
namespace {

std::vector<Point2> any_points(Rng& rng, std::size_t count) {
  std::vector<Point2> points;
  for (std::size_t i = 0; i < count; ++i) points.push_back({rng.uniform(0, 30), rng.uniform(0, 30)});
  return points;
}

std::vector<std::size_t> counting(std::size_t count) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  return order;
}

TEST(Route, GoesAlongALine) {
  const std::vector<Point2> points{{9, 0}, {1, 0}, {5, 0}};
  EXPECT_EQ(shortest_order({0, 0}, points, straight_distance()), (std::vector<std::size_t>{1, 2, 0}));
  EXPECT_TRUE(shortest_order({0, 0}, {}, straight_distance()).empty());
}

TEST(Route, IsNotFooledByTheNearestFirst) {
  // From 0 the nearest is +1, but going to -1.2 first and then right for good is shorter.
  const std::vector<Point2> points{{1, 0}, {-1.2, 0}, {10, 0}};
  EXPECT_EQ(shortest_order({0, 0}, points, straight_distance()), (std::vector<std::size_t>{1, 0, 2}));
}

TEST(Route, IsAsShortAsTheBestOfAllOrders) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    Rng rng{seed};
    const Point2 start{rng.uniform(0, 30), rng.uniform(0, 30)};
    const auto points = any_points(rng, 1 + seed % 7);
    auto order = counting(points.size());
    double best = 1e9;
    do {
      best = std::min(best, route_length(start, points, order, straight_distance()));
    } while (std::next_permutation(order.begin(), order.end()));
    const auto found = shortest_order(start, points, straight_distance());
    EXPECT_NEAR(route_length(start, points, found, straight_distance()), best, 1e-6) << "seed " << seed;
  }
}

TEST(Route, ManyStopsAreAPermutationAndNoLongerThanNearestFirst) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Rng rng{seed};
    const auto points = any_points(rng, 25);
    auto order = shortest_order({0, 0}, points, straight_distance());
    const double length = route_length({0, 0}, points, order, straight_distance());
    double nearest_first = 0.0;
    auto left = counting(points.size());
    Point2 at{0, 0};
    while (!left.empty()) {
      const auto nearest = std::min_element(left.begin(), left.end(), [&](std::size_t a, std::size_t b) {
        return distance(at, points[a]) < distance(at, points[b]);
      });
      nearest_first += distance(at, points[*nearest]);
      at = points[*nearest];
      left.erase(nearest);
    }
    EXPECT_LE(length, nearest_first + 1e-9) << "seed " << seed;
    std::sort(order.begin(), order.end());
    EXPECT_EQ(order, counting(points.size()));
  }
}

TEST(Route, WhatCannotBeReachedComesLast) {
  const TravelDistance walled = [](Point2 from, Point2 to) {
    return (from.x < 5) == (to.x < 5) ? distance(from, to) : std::numeric_limits<double>::infinity();
  };
  const std::vector<Point2> points{{6, 0}, {4, 0}, {1, 0}};
  EXPECT_EQ(shortest_order({0, 0}, points, walled), (std::vector<std::size_t>{2, 1, 0}));
}

}  // namespace
}  // namespace docent::task_control
