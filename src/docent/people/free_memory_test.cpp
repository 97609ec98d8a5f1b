#include "docent/people/free_memory.h"

#include <gtest/gtest.h>

#include "docent/people/testing.h"

namespace docent::people {
namespace {

void watch(FreeMemory& memory, const Scene& scene, double from, double to) {
  for (double t = from; t < to; t += 0.1) {
    const PeopleSweep seen = scene.sweep(false);
    memory.add(seen.sweep, seen.odom_from_base, time_from_seconds(t));
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
