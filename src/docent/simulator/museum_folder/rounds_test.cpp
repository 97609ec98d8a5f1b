#include "docent/simulator/museum_folder/rounds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "docent/base/random.h"
#include "docent/geometry/pose2.h"

namespace docent::simulator {
namespace {

/// Straight from each to each; the first is home.
std::vector<std::vector<double>> straight(const std::vector<Point2>& points) {
  std::vector<std::vector<double>> ways;
  for (const Point2 from : points) {
    ways.emplace_back();
    for (const Point2 to : points) ways.back().push_back(distance(from, to));
  }
  return ways;
}

double length_of(const std::vector<std::vector<double>>& ways, const std::vector<std::vector<std::size_t>>& rounds) {
  double length = 0.0;
  std::size_t here = 0;
  for (const auto& round : rounds)
    for (const std::size_t stop : round) length += ways[here][stop + 1], here = stop + 1;
  return length + ways[here][0];
}

TEST(Rounds, GoOnceToEveryPlaceInPiecesThatAVisitorFollows) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Rng rng{seed};
    std::vector<Point2> points(static_cast<std::size_t>(rng.integer(3, 24)));
    for (Point2& point : points) point = {rng.uniform(0.0, 60.0), rng.uniform(0.0, 40.0)};
    const auto rounds = rounds_of(straight(points));
    std::set<std::size_t> seen;
    std::size_t least = points.size();
    std::size_t most = 0;
    for (const auto& round : rounds) {
      seen.insert(round.begin(), round.end());
      least = std::min(least, round.size());
      most = std::max(most, round.size());
    }
    EXPECT_EQ(seen.size() + 1, points.size()) << seed;
    EXPECT_LE(most, kMostStopsOfARound) << seed;
    EXPECT_LE(most - least, 1U) << seed;
  }
}

TEST(Rounds, AreShortWhereTheOrderOfThePlacesIsNot) {
  // On a circle, given crosswise: the short way is round the circle.
  std::vector<Point2> points{{10.5, 0.0}};
  for (int i = 0; i < 12; ++i) points.push_back(10.0 * unit(Angle::degrees(30.0 * ((i * 5) % 12))));
  const auto ways = straight(points);
  const double side = 20.0 * std::sin(std::numbers::pi / 12.0);
  EXPECT_NEAR(length_of(ways, rounds_of(ways)), 12.0 * side, 1.5);
}

TEST(Rounds, GoByTheWayAndNotThroughWalls) {
  // The second stop is near home as the crow flies, and far round the wall.
  const std::vector<std::vector<double>> ways{{0, 5, 30, 10}, {5, 0, 25, 5}, {30, 25, 0, 20}, {10, 5, 20, 0}};
  EXPECT_EQ(rounds_of(ways), (std::vector<std::vector<std::size_t>>{{0, 2, 1}}));
}

TEST(Rounds, AreMoreOfThemWhereTheFloorIsLong) {
  std::vector<Point2> points{{0.0, 0.0}};
  for (const double x : {-50.0, -45.0, 45.0, 50.0}) points.push_back({x, 0.0});
  EXPECT_EQ(rounds_of(straight(points)).size(), 2U) << "200 m";
  for (Point2& point : points) point = 0.5 * point;
  EXPECT_EQ(rounds_of(straight(points)).size(), 1U) << "100 m";
  EXPECT_EQ(rounds_of(straight({{0.0, 0.0}, {500.0, 0.0}})).size(), 1U) << "one stop is one round, however far";
}

TEST(Rounds, OfNothingAreNone) {
  EXPECT_TRUE(rounds_of({}).empty());
  EXPECT_TRUE(rounds_of(straight({{0.0, 0.0}})).empty());
}

}  // namespace
}  // namespace docent::simulator
