#include "docent/simulator/museum_folder/rounds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "docent/base/random.h"

namespace docent::simulator {
namespace {

double length_of(Point2 home, const std::vector<Point2>& places, const std::vector<std::vector<std::size_t>>& rounds) {
  double length = 0.0;
  Point2 here = home;
  for (const auto& round : rounds)
    for (const std::size_t place : round) length += distance(here, places[place]), here = places[place];
  return length + distance(here, home);
}

TEST(Rounds, GoOnceToEveryPlaceInPiecesThatAVisitorFollows) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Rng rng{seed};
    std::vector<Point2> places(static_cast<std::size_t>(rng.integer(2, 23)));
    for (Point2& place : places) place = {rng.uniform(0.0, 60.0), rng.uniform(0.0, 40.0)};
    const auto rounds = rounds_of({1.0, 1.0}, places);
    std::set<std::size_t> seen;
    std::size_t least = places.size();
    std::size_t most = 0;
    for (const auto& round : rounds) {
      seen.insert(round.begin(), round.end());
      least = std::min(least, round.size());
      most = std::max(most, round.size());
    }
    EXPECT_EQ(seen.size(), places.size()) << seed;
    EXPECT_LE(most, kMostStopsOfARound) << seed;
    EXPECT_LE(most - least, 1U) << seed;
  }
}

TEST(Rounds, AreShortWhereTheOrderOfThePlacesIsNot) {
  // On a circle, given crosswise: the short way is round the circle.
  std::vector<Point2> places;
  for (int i = 0; i < 12; ++i) {
    const Point2 at = unit(Angle::degrees(30.0 * ((i * 5) % 12)));
    places.push_back({10.0 * at.x, 10.0 * at.y});
  }
  const Point2 home{10.5, 0.0};
  const double side = distance(Point2{10.0, 0.0}, 10.0 * unit(Angle::degrees(30.0)));
  EXPECT_NEAR(length_of(home, places, rounds_of(home, places)), 12.0 * side, 1.5);
}

TEST(Rounds, OfFewPlacesAreOne) {
  const std::vector<Point2> places{{5.0, 0.0}, {1.0, 0.0}, {3.0, 0.0}};
  EXPECT_EQ(rounds_of({0.0, 0.0}, places), (std::vector<std::vector<std::size_t>>{{1, 2, 0}}));
  EXPECT_TRUE(rounds_of({0.0, 0.0}, {}).empty());
}

}  // namespace
}  // namespace docent::simulator
