#include "docent/collision_avoidance/watches/tactile_watch.h"

#include <gtest/gtest.h>

#include <vector>

namespace docent::collision_avoidance::tactile_watch_test {
namespace {

struct Ring {
  TactileWatch watch;
  std::vector<std::uint8_t> segments = std::vector<std::uint8_t>(24, 0);
  double now = 0.0;  // [s]
  double late = 0.0;
  std::uint32_t scan = 0;
  std::uint32_t step = 1;

  void run(double duration) {
    for (const double end = now + duration; now < end; now += 0.2)
      watch.feel(time_from_seconds(now), time_from_seconds(now - late), segments, scan += step);
    now -= 0.2;
  }
  [[nodiscard]] std::string reason() const {
    const auto found = watch.complaint(time_from_seconds(now), false);
    return found ? found->reason : "";
  }
};

TEST(TactileWatch, ARobotWithoutTheRingIsNotBlamed) {
  EXPECT_FALSE(TactileWatch{}.complaint(time_from_seconds(5.0), false));
}

TEST(TactileWatch, ARingThatNeverSpokeIsMissedWhereThereIsOne) {
  const auto found = TactileWatch{}.complaint(time_from_seconds(5.0), true);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->reason, "the tactile ring is silent");
  EXPECT_EQ(found->max_speed, 0.0);
}

TEST(TactileWatch, WhatNobodyTouchesSaysTheSameForHours) {
  Ring ring;
  ring.run(3600.0);
  EXPECT_EQ(ring.reason(), "");
}

TEST(TactileWatch, ACountThatStandsIsAFrozenRing) {
  Ring ring;
  ring.run(3.0);
  ring.step = 0;
  ring.run(0.7);
  EXPECT_EQ(ring.reason(), "the tactile ring is frozen");
  Ring without_count;
  without_count.step = 0;
  without_count.run(5.0);
  EXPECT_EQ(without_count.reason(), "");
}

TEST(TactileWatch, SilentLateAndHalfGone) {
  Ring ring;
  ring.run(3.0);
  ring.now += 1.0;
  EXPECT_EQ(ring.reason(), "the tactile ring is silent");
  ring.run(2.0);
  ring.late = 1.2;
  ring.run(0.5);
  EXPECT_EQ(ring.reason(), "the tactile ring's word comes late");
  ring.late = 0.0;
  ring.run(1.0);
  for (std::size_t i = 0; i < 24; i += 2) ring.segments[i] = TactileWatch::kNoReading;
  ring.run(1.0);
  EXPECT_EQ(ring.reason(), "the tactile ring gives too few readings");
}

}  // namespace
}  // namespace docent::collision_avoidance::tactile_watch_test
