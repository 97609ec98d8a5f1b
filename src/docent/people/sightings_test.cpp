#include "docent/people/sightings.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "docent/people/breadth.h"
#include "docent/people/testing.h"

namespace docent::people {
namespace {

/// By somebody who remembers nothing and expects nobody.
std::vector<PersonSighting> seen_in(const PeopleSweep& sweep) {
  FreeMemory memory;
  return find_people(sweep, memory, {}, {});
}

TEST(FindPeople, TwoLegsAreOnePerson) {
  Rng rng{1};
  for (int i = 0; i < 30; ++i) {
    Scene scene{&rng};
    const double range = rng.uniform(0.8, 3.0);
    const double stride = rng.uniform(-0.12, 0.12);
    scene.add_disc({range + stride, 0.13}, 0.06);
    scene.add_disc({range - stride, -0.13}, 0.06);
    const auto people = seen_in(scene.sweep());
    ASSERT_EQ(people.size(), 1U) << range << " " << stride;
    EXPECT_LT(distance(people[0].position, {range, 0.0}), 0.3) << range << " " << stride;
  }
}

TEST(FindPeople, SomebodySeenBetweenTwoLegsDoesNotMakeThemTwo) {
  Scene scene;
  scene.add_disc({1.6, 0.12}, 0.06);
  scene.add_disc({1.6, -0.12}, 0.06);
  scene.add_disc({3.0, 0.0}, 0.24);
  const auto people = seen_in(scene.sweep());
  ASSERT_EQ(people.size(), 2U);
  EXPECT_LT(distance(people[0].position, {1.6, 0.0}), 0.2);
  EXPECT_LT(distance(people[1].position, {3.0, 0.0}), 0.2);
}

TEST(FindPeople, LeavesTheMapOutAndSeesWhoStandsBeforeIt) {
  Scene scene;
  scene.add_wall({4.0, -3.0}, {4.0, 3.0}, true);
  scene.add_disc({3.6, 1.0}, 0.24);
  const auto people = seen_in(scene.sweep());
  ASSERT_EQ(people.size(), 1U);
  EXPECT_LT(distance(people[0].position, {3.6, 1.0}), 0.15);
  EXPECT_TRUE(people[0].by_map);
}

TEST(FindPeople, WhoIsBehindTheRobotIsOnePerson) {
  Scene scene;
  scene.add_disc({-2.0, 0.0}, 0.24);  // where bearings wrap round
  const auto people = seen_in(scene.sweep());
  ASSERT_EQ(people.size(), 1U);
  EXPECT_LT(distance(people[0].position, {-2.0, 0.0}), 0.1);
}

TEST(FindPeople, WithoutAMapOnlyWhatStandsByItself) {
  Scene scene;
  scene.add_wall({4.0, -3.0}, {4.0, 3.0});
  scene.add_wall({-3.0, -3.0}, {-3.0, 3.0});
  scene.add_disc({2.0, 1.0}, 0.24);
  const auto people = seen_in(scene.sweep(false));
  ASSERT_EQ(people.size(), 1U);
  EXPECT_LT(distance(people[0].position, {2.0, 1.0}), 0.15);
  EXPECT_FALSE(people[0].by_map);
}

TEST(FindPeople, OneLegIsNarrowAndAStoolIsBroad) {
  Rng rng{2};
  double breadths = 0.0;
  int stools = 0;
  for (int i = 0; i < 50; ++i) {
    Scene scene{&rng};
    const double range = rng.uniform(0.8, 3.0);
    scene.add_disc({range, 0.1}, 0.07);
    scene.add_disc({range, -0.1}, 0.07);
    scene.add_disc({-range, 0.0}, 0.18);  // where bearings wrap round
    for (const PersonSighting& sighting : seen_in(scene.sweep())) {
      if (sighting.position.x > 0.0) {
        EXPECT_LT(sighting.breadth, 0.2) << range;
        continue;
      }
      breadths += sighting.breadth;
      ++stools;
    }
  }
  ASSERT_GT(stools, 40);
  EXPECT_GT(breadths / stools, BreadthParams{}.broad);
}

TEST(FindPeople, APieceOfABenchIsAPieceOfABench) {
  constexpr Point2 kLeft{2.4, 0.25};  // of somebody before the bench
  constexpr Point2 kRight{2.4, -0.25};
  Scene whole;
  whole.add_wall({3.0, -0.9}, {3.0, 0.9});
  Scene hidden = whole;
  hidden.add_disc(kLeft, 0.12);
  hidden.add_disc(kRight, 0.12);
  const auto at_bench = [](FreeMemory& memory, const Scene& scene) {
    const PeopleSweep seen = scene.sweep();
    std::vector<PersonSighting> pieces = find_people(seen, memory, {}, {});
    std::erase_if(pieces, [](const PersonSighting& sighting) { return sighting.position.x < 2.9; });
    return pieces;
  };
  const auto count_people = [&](FreeMemory& memory) {
    const auto pieces = at_bench(memory, hidden);
    EXPECT_FALSE(pieces.empty());
    return std::count_if(pieces.begin(), pieces.end(), [](const auto& piece) { return piece.thing_gain < 1.0; });
  };
  const auto remember = [](FreeMemory& memory, const Scene& scene, double time) {
    const PeopleSweep seen = scene.sweep();
    memory.add(seen.sweep, seen.origins, seen.odom_from_base, time_from_seconds(time));
  };
  FreeMemory memory;
  remember(memory, hidden, 0.0);
  EXPECT_GE(count_people(memory), 1) << "nobody knows yet what it belongs to";
  FreeMemory knows;
  remember(knows, whole, 0.0);
  for (const PersonSighting& piece : at_bench(knows, whole)) EXPECT_GT(piece.thing_gain, 1.0);
  remember(knows, hidden, 1.0);
  EXPECT_EQ(count_people(knows), 0);
}

TEST(FindPeople, NobodyWhereNothingIs) { EXPECT_TRUE(seen_in(Scene{}.sweep()).empty()); }

}  // namespace
}  // namespace docent::people
