#include "docent/people/people_tracker.h"

#include <gtest/gtest.h>

#include "docent/base/random.h"

namespace docent {
namespace {

TEST(PeopleTracker, FollowsTwoWhoCross) {
  PeopleTracker tracker{{}};
  Rng rng{3};
  for (int i = 0; i <= 40; ++i) {
    const double t = 0.1 * i;
    const std::vector<PersonSighting> sightings{{{-2.0 + t + rng.normal(0.0, 0.03), 0.5 + rng.normal(0.0, 0.03)}, 5},
                                                {{2.0 - t + rng.normal(0.0, 0.03), -0.5 + rng.normal(0.0, 0.03)}, 5}};
    tracker.update(sightings, time_from_seconds(t));
  }
  const auto people = tracker.people();
  ASSERT_EQ(people.size(), 2U);
  EXPECT_EQ(people[0].id, 1U);
  EXPECT_NEAR(people[0].position.x, 2.0, 0.15);
  EXPECT_NEAR(people[0].velocity.x, 1.0, 0.2);
  EXPECT_NEAR(people[1].position.x, -2.0, 0.15);
  EXPECT_NEAR(people[1].velocity.x, -1.0, 0.2);
  EXPECT_NEAR(people[1].velocity.y, 0.0, 0.2);
}

TEST(PeopleTracker, CountsNobodyTooSoonAndForgetsInTime) {
  PeopleTracker tracker{{}};
  const std::vector<PersonSighting> one{{{1.0, 1.0}, 5}};
  tracker.update(one, time_from_seconds(0.0));
  tracker.update(one, time_from_seconds(0.1));
  EXPECT_TRUE(tracker.people().empty());
  tracker.update(one, time_from_seconds(0.2));
  EXPECT_EQ(tracker.people().size(), 1U);
  tracker.update({}, time_from_seconds(1.2));
  EXPECT_EQ(tracker.people().size(), 1U);
  tracker.update({}, time_from_seconds(1.6));
  EXPECT_TRUE(tracker.people().empty());
}

TEST(PeopleTracker, KeepsWhoIsHiddenForAMoment) {
  PeopleTracker tracker{{}};
  for (int i = 0; i < 20; ++i) {
    std::vector<PersonSighting> sightings{{{0.1 * i, 0.0}, 5}};
    if (i > 10 && i < 17) sightings.clear();
    tracker.update(sightings, time_from_seconds(0.1 * i));
  }
  const auto people = tracker.people();
  ASSERT_EQ(people.size(), 1U);
  EXPECT_EQ(people[0].id, 1U);
  EXPECT_NEAR(people[0].position.x, 1.9, 0.1);
}

}  // namespace
}  // namespace docent
