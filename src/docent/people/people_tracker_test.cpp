#include "docent/people/people_tracker.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "docent/base/random.h"
#include "docent/people/testing.h"

namespace docent::people {
namespace {

/// Beams that tell nothing of anybody.
Sightlines blind() { return {sensor_models::RangeSweep{}, Pose2{}}; }

void step(PeopleTracker& tracker, double t, const std::vector<Point2>& seen, const Sightlines& lines = blind()) {
  std::vector<PersonSighting> sightings;
  for (const Point2 place : seen) {
    PersonSighting sighting;
    sighting.position = place;
    sighting.points = 5;
    sighting.by_map = sighting.is_mapped = true;
    sighting.has_come = true;
    sightings.push_back(sighting);
  }
  tracker.predict(time_from_seconds(t));
  tracker.update(sightings, lines);
}

TEST(PeopleTracker, FollowsTwoWhoCross) {
  PeopleTracker tracker{{}};
  Rng rng{3};
  for (int i = 0; i <= 40; ++i) {
    const double t = 0.1 * i;
    step(tracker, t,
         {{-2.0 + t + rng.normal(0.0, 0.03), 0.5 + rng.normal(0.0, 0.03)},
          {2.0 - t + rng.normal(0.0, 0.03), -0.5 + rng.normal(0.0, 0.03)}});
  }
  const auto& tracks = tracker.tracks();
  ASSERT_EQ(tracks.size(), 2U);
  EXPECT_EQ(tracks[0].person.id, 1U);
  EXPECT_NEAR(tracks[0].person.position.x, 2.0, 0.15);
  EXPECT_NEAR(tracks[0].person.velocity.x, 1.0, 0.2);
  EXPECT_NEAR(tracks[1].person.position.x, -2.0, 0.15);
  EXPECT_NEAR(tracks[1].person.velocity.x, -1.0, 0.2);
  EXPECT_NEAR(tracks[1].person.velocity.y, 0.0, 0.2);
  EXPECT_TRUE(tracks[0].moved);
}

TEST(PeopleTracker, CountsNobodyTooSoonAndForgetsInTime) {
  PeopleTracker tracker{{}};
  for (int i = 0; i < 3; ++i) {
    step(tracker, 0.1 * i, {{1.0, 1.0}});
    EXPECT_EQ(tracker.places().size(), i < 2 ? 0U : 1U);
  }
  for (int i = 3; i < 30; ++i) {
    step(tracker, 0.1 * i, {});
    if (i == 10) {
      EXPECT_EQ(tracker.places().size(), 1U);
    }
  }
  EXPECT_TRUE(tracker.places().empty());
}

TEST(PeopleTracker, TheSweepSaysHowLongToWait) {
  const Point2 place{4.0, 0.0};
  Scene open;
  Scene covered;
  covered.add_disc({2.0, 0.0}, 0.3);
  const auto patience = [&](const Scene& scene) {
    PeopleTracker tracker{{}};
    for (int i = 0; i < 5; ++i) step(tracker, 0.1 * i, {place});
    const PeopleSweep seen = scene.sweep();
    const Sightlines lines{seen.sweep, seen.odom_from_base};
    int i = 5;
    for (; i < 200 && !tracker.places().empty(); ++i) step(tracker, 0.1 * i, {}, lines);
    return 0.1 * (i - 5);
  };
  EXPECT_NEAR(patience(open), PeopleTrackerParams{}.patience, 0.15);
  EXPECT_NEAR(patience(covered), PeopleTrackerParams{}.patience_hidden, 0.15);
}

TEST(PeopleTracker, KeepsWhoIsHiddenForAMoment) {
  PeopleTracker tracker{{}};
  for (int i = 0; i < 20; ++i) {
    std::vector<Point2> seen{{0.1 * i, 0.0}};
    if (i > 10 && i < 16) seen.clear();
    step(tracker, 0.1 * i, seen);
  }
  ASSERT_EQ(tracker.tracks().size(), 1U);
  EXPECT_EQ(tracker.tracks()[0].person.id, 1U);
  EXPECT_NEAR(tracker.tracks()[0].person.position.x, 1.9, 0.15);
}

TEST(PeopleTracker, ASecondLegIsNobody) {
  PeopleTracker tracker{{}};
  int most = 0;
  for (int i = 0; i < 100; ++i) {
    const double x = 0.08 * i;
    const double stride = i % 16 < 8 ? 0.17 : -0.17;
    std::vector<Point2> seen{{x, 0.0}};
    if (i > 10 && i % 8 < 4) seen = {{x + stride, 0.1}, {x - stride, -0.1}};  // legs apart, and together again
    step(tracker, 0.1 * i, seen);
    most = std::max(most, static_cast<int>(tracker.places().size()));
  }
  EXPECT_EQ(most, 1);
  EXPECT_EQ(tracker.tracks()[0].person.id, 1U);
}

TEST(PeopleTracker, WhoStepsOutFromBesideSomebodyIsSomebody) {
  PeopleTracker tracker{{}};
  for (int i = 0; i < 10; ++i) step(tracker, 0.1 * i, {{2.0, 0.0}});
  for (int i = 10; i < 13; ++i) step(tracker, 0.1 * i, {{2.0, 0.0}, {2.0, 0.38}});
  EXPECT_EQ(tracker.places().size(), 1U);
  for (int i = 13; i < 16; ++i) step(tracker, 0.1 * i, {{2.0, 0.0}, {2.0, 0.38}});
  EXPECT_EQ(tracker.places().size(), 2U) << "both are seen all the time";
  PeopleTracker other{{}};
  for (int i = 0; i < 10; ++i) step(other, 0.1 * i, {{2.0, 0.0}});
  for (int i = 10; i < 13; ++i) step(other, 0.1 * i, {{2.0, 0.0}, {2.0, 0.38 + 0.15 * (i - 10)}});
  EXPECT_EQ(other.places().size(), 2U) << "goes away";
}

}  // namespace
}  // namespace docent::people
