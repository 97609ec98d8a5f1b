#include "docent/people/sightings.h"

#include <gtest/gtest.h>

#include "docent/people/testing.h"

namespace docent::people {
namespace {

TEST(FindPeople, TwoLegsAreOnePerson) {
  Rng rng{1};
  for (int i = 0; i < 30; ++i) {
    Scene scene{&rng};
    const double range = rng.uniform(0.8, 3.0);
    const double stride = rng.uniform(-0.12, 0.12);
    scene.add_disc({range + stride, 0.13}, 0.06);
    scene.add_disc({range - stride, -0.13}, 0.06);
    const auto people = find_people(scene.sweep(), {}, {}, {});
    ASSERT_EQ(people.size(), 1U) << range << " " << stride;
    EXPECT_LT(distance(people[0].position, {range, 0.0}), 0.3) << range << " " << stride;
  }
}

TEST(FindPeople, SomebodySeenBetweenTwoLegsDoesNotMakeThemTwo) {
  Scene scene;
  scene.add_disc({1.6, 0.12}, 0.06);
  scene.add_disc({1.6, -0.12}, 0.06);
  scene.add_disc({3.0, 0.0}, 0.24);
  const auto people = find_people(scene.sweep(), {}, {}, {});
  ASSERT_EQ(people.size(), 2U);
  EXPECT_LT(distance(people[0].position, {1.6, 0.0}), 0.2);
  EXPECT_LT(distance(people[1].position, {3.0, 0.0}), 0.2);
}

TEST(FindPeople, LeavesTheMapOutAndSeesWhoStandsBeforeIt) {
  Scene scene;
  scene.add_wall({4.0, -3.0}, {4.0, 3.0}, true);
  scene.add_disc({3.6, 1.0}, 0.24);
  const auto people = find_people(scene.sweep(), {}, {}, {});
  ASSERT_EQ(people.size(), 1U);
  EXPECT_LT(distance(people[0].position, {3.6, 1.0}), 0.15);
  EXPECT_TRUE(people[0].by_map);
}

TEST(FindPeople, WhoIsBehindTheRobotIsOnePerson) {
  Scene scene;
  scene.add_disc({-2.0, 0.0}, 0.24);  // where bearings wrap round
  const auto people = find_people(scene.sweep(), {}, {}, {});
  ASSERT_EQ(people.size(), 1U);
  EXPECT_LT(distance(people[0].position, {-2.0, 0.0}), 0.1);
}

TEST(FindPeople, WithoutAMapOnlyWhatStandsByItself) {
  Scene scene;
  scene.add_wall({4.0, -3.0}, {4.0, 3.0});
  scene.add_wall({-3.0, -3.0}, {-3.0, 3.0});
  scene.add_disc({2.0, 1.0}, 0.24);
  const auto people = find_people(scene.sweep(false), {}, {}, {});
  ASSERT_EQ(people.size(), 1U);
  EXPECT_LT(distance(people[0].position, {2.0, 1.0}), 0.15);
  EXPECT_FALSE(people[0].by_map);
}

TEST(FindPeople, NobodyWhereNothingIs) { EXPECT_TRUE(find_people(Scene{}.sweep(), {}, {}, {}).empty()); }

}  // namespace
}  // namespace docent::people
