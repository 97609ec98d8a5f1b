#include "docent/people/standing_things.h"

#include <gtest/gtest.h>

#include "docent/people/testing.h"

namespace docent::people {
namespace {

constexpr Point2 kPlant{2.0, 0.0};

void stand(StandingThings& things, Point2 place, bool came, double from, double to) {
  for (double t = from; t < to; t += 0.5) things.see(place, came, time_from_seconds(t));
}

TEST(StandingThings, WhatNeverMovedIsAThingInTheEnd) {
  const double patience = StandingThingParams{}.patience();
  StandingThings things{{}};
  stand(things, kPlant, false, 0.0, patience - 1.0);
  EXPECT_FALSE(things.is_thing(kPlant));
  stand(things, kPlant, false, patience - 1.0, patience + 2.0);
  EXPECT_TRUE(things.is_thing(kPlant));
  EXPECT_FALSE(things.is_thing({2.0, 0.6})) << "somebody beside it";
}

TEST(StandingThings, WhoCameStaysAPerson) {
  StandingThings things{{}};
  stand(things, kPlant, true, 0.0, 600.0);
  EXPECT_FALSE(things.is_thing(kPlant));
}

TEST(StandingThings, SomebodyWhoPassesDoesNotBringAPlantToLife) {
  StandingThings things{{}};
  const double patience = StandingThingParams{}.patience();
  stand(things, kPlant, false, 0.0, 0.5 * patience);
  things.see(kPlant, true, time_from_seconds(0.5 * patience));
  stand(things, kPlant, false, 0.5 * patience, patience + 2.0);
  EXPECT_TRUE(things.is_thing(kPlant));
}

TEST(StandingThings, RemembersOutOfSightAndForgetsWhatIsSeenFree) {
  StandingThings things{{}};
  stand(things, kPlant, false, 0.0, 200.0);
  things.see(kPlant, false, time_from_seconds(900.0));
  EXPECT_TRUE(things.is_thing(kPlant));
  const PeopleSweep seen = Scene{}.sweep();
  const Sightlines lines{seen.sweep, seen.odom_from_base};
  things.forget(lines, Pose2{}, {}, 6.0, time_from_seconds(901.0));
  EXPECT_TRUE(things.is_thing(kPlant)) << "one sweep may be wrong";
  for (int i = 0; i < 10; ++i) things.forget(lines, Pose2{}, {}, 6.0, time_from_seconds(902.0));
  EXPECT_FALSE(things.is_thing(kPlant));
}

TEST(StandingThings, ATimeOutOfSightCountsLittle) {
  StandingThings things{{}};
  things.see(kPlant, false, time_from_seconds(0.0));
  things.see(kPlant, false, time_from_seconds(500.0));
  EXPECT_FALSE(things.is_thing(kPlant)) << "that may be another visitor";
}

}  // namespace
}  // namespace docent::people
