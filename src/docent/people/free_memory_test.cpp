#include "docent/people/free_memory.h"

#include <gtest/gtest.h>

#include "docent/people/testing.h"

namespace docent::people {
namespace {

void watch(FreeMemory& memory, const Scene& scene, double from, double to, bool knows = false) {
  for (double t = from; t < to; t += 0.1) {
    const PeopleSweep seen = scene.sweep(knows);
    memory.add(seen.sweep, seen.origins, seen.odom_from_base, time_from_seconds(t));
  }
}

TEST(FreeMemory, KnowsWhoCameFromWhatStood) {
  FreeMemory memory;
  Scene before;
  before.add_wall({5.0, -4.0}, {5.0, 4.0});
  before.add_disc({2.0, 1.5}, 0.25);
  watch(memory, before, 0.0, 1.0);
  Scene after = before;
  after.add_disc({2.5, -1.0}, 0.25);
  watch(memory, after, 1.0, 2.0);
  const double near = norm({2.5, -1.0}) - 0.25;
  EXPECT_TRUE(memory.has_come((near / norm({2.5, -1.0})) * Point2{2.5, -1.0}));
  const double stood = norm({2.0, 1.5}) - 0.25;
  EXPECT_FALSE(memory.has_come((stood / norm({2.0, 1.5})) * Point2{2.0, 1.5}));
  EXPECT_FALSE(memory.has_come({5.0, 0.0}));
  EXPECT_FALSE(memory.has_come({8.0, 8.0})) << "never seen";
}

TEST(FreeMemory, LeavesNoHoleBetweenTheBeamsOfAnEmptyHall) {
  for (const double away : {0.8, 1.3, 2.0, 2.6}) {
    for (int i = 0; i < 40; ++i) {
      FreeMemory memory;
      Scene hall;
      hall.add_disc({0.9, 0.0}, 0.1);  // its neighbours must not count on the short beams that end there
      hall.add_wall({5.6, -6.0}, {5.6, 6.0});
      watch(memory, hall, 0.0, 0.5);
      const Point2 place = away * unit(Angle::degrees(25.0 + 310.0 * i / 39.0));
      Scene after = hall;
      after.add_disc(place, 0.2);
      watch(memory, after, 0.5, 1.0);
      EXPECT_TRUE(memory.has_come((1.0 - 0.2 / away) * place)) << away << " m, " << i;
    }
  }
}

TEST(FreeMemory, TheRimOfWhatTheMapHoldsHasNotCome) {
  Scene before;
  before.add_wall({5.0, -4.0}, {5.0, 4.0}, true);
  Scene after = before;
  after.add_wall({2.5, -0.2}, {2.5, 1.0}, true);  // a panel that beams passed as long as they grazed it
  for (const bool knows : {true, false}) {
    FreeMemory memory;
    watch(memory, before, 0.0, 1.0, knows);
    watch(memory, after, 1.0, 2.0, knows);
    EXPECT_EQ(memory.has_come({2.5, 0.0}), !knows);
  }
}

TEST(FreeMemory, RemembersAThingUntilBeamsPass) {
  FreeMemory memory;
  Scene bench;
  bench.add_wall({2.53, -0.9}, {2.53, 0.9});
  watch(memory, bench, 0.0, 1.0);
  EXPECT_FALSE(memory.is_thing({2.53, 0.0}));
  memory.mark_thing({2.53, 0.0});
  EXPECT_TRUE(memory.is_thing({2.53, 0.0}));
  EXPECT_TRUE(memory.is_thing({2.53, 0.1})) << "the next cell";
  EXPECT_FALSE(memory.is_thing({2.53, 0.4}));
  watch(memory, bench, 1.0, 5.0);
  EXPECT_TRUE(memory.is_thing({2.53, 0.0}));
  watch(memory, Scene{}, 5.0, 8.0);
  EXPECT_FALSE(memory.is_thing({2.53, 0.0}));
}

TEST(FreeMemory, WhoHasComeIsNoThing) {
  FreeMemory memory;
  watch(memory, Scene{}, 0.0, 1.0);
  Scene after;
  after.add_disc({2.55, 0.05}, 0.2);
  watch(memory, after, 1.0, 2.0);
  ASSERT_TRUE(memory.has_come({2.35, 0.05}));
  memory.mark_thing({2.35, 0.05});
  EXPECT_FALSE(memory.is_thing({2.35, 0.05}));
  EXPECT_TRUE(memory.has_come({2.35, 0.05}));
}

TEST(FreeMemory, ForgetsAfterAWhile) {
  FreeMemory memory;
  watch(memory, Scene{}, 0.0, 1.0);
  Scene later;
  later.add_disc({2.5, 0.0}, 0.25);
  watch(memory, later, 200.0, 200.5);
  EXPECT_FALSE(memory.has_come({2.25, 0.0}));
}

}  // namespace
}  // namespace docent::people
