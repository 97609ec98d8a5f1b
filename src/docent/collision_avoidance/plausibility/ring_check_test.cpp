#include "docent/collision_avoidance/plausibility/ring_check.h"

#include <gtest/gtest.h>

#include <vector>

#include "docent/collision_avoidance/plausibility/ring_for_test.h"

namespace docent::collision_avoidance::ring_check_test {
namespace {

/// A laser in the middle of a ring of sonars, in a room.
class RingCheckTest : public ::testing::Test {
 protected:
  RingCheckTest() { room.box(-2, -1.6, 2.2, 1.4); }
  /// The last of some sweeps, each with all of the ring. @param heard  by the ring
  RingCheck::Finding look(double scale, double offset, const RoomForTest& heard, double late = 0.0) {
    RingCheck::Finding found;
    for (int k = 0; k < 3; ++k) {
      const double time = 1.0 + 0.1 * k;
      ring.hear(time - late, heard, {}, {});
      SensorSweep sweep = room.sweep(time, {});
      for (float& range : sweep.ranges) range = static_cast<float>(scale * static_cast<double>(range) + offset);
      found = check.add(view_of(sweep, {}), ring.echoes.all());
    }
    return found;
  }
  RoomForTest room;
  RingForTest ring;
  RingCheck check;
};

TEST_F(RingCheckTest, ALaserInOrderMeetsWhatTheRingHears) {
  const auto found = look(1.0, 0.0, room);
  EXPECT_TRUE(found.in_order);
  EXPECT_FALSE(found.too_long);
  EXPECT_GT(check.agreement().value_or(0.0), 0.9);
}

TEST_F(RingCheckTest, AnOffsetAndAFactorShowAtOnce) {
  const auto off = look(1.0, 0.5, room);
  ASSERT_TRUE(off.too_long);
  EXPECT_FALSE(off.in_order);
  EXPECT_NEAR(off.too_long->offset, 0.5, 0.15);
  EXPECT_LT(check.agreement().value_or(1.0), 0.3);
  const auto twice = look(2.0, 0.0, room);
  ASSERT_TRUE(twice.too_long);
  EXPECT_NEAR(twice.too_long->scale, 2.0, 0.3);
}

TEST_F(RingCheckTest, ALowBenchIsNoLie) {
  RoomForTest heard = room;
  heard.walls.push_back({{1.7, -1.6}, {1.7, 1.4}});  // half a metre before the wall ahead
  const auto found = look(1.0, 0.0, heard);
  EXPECT_FALSE(found.too_long);
}

TEST_F(RingCheckTest, TooShortIsForOthersToFind) { EXPECT_FALSE(look(0.5, 0.0, room).too_long); }

TEST_F(RingCheckTest, WhatWasHeardLongAgoSaysNothing) {
  EXPECT_FALSE(look(2.0, 0.0, room, 0.3).too_long);
  EXPECT_FALSE(check.agreement());
}

TEST_F(RingCheckTest, ALaserThatAgreesWithTheRingFollowsNoLaw) {
  (void)look(1.0, 0.0, room);
  RangeLaw law;
  law.offset = 0.5;
  EXPECT_TRUE(check.contradicts(law, time_from_seconds(1.0)));
  EXPECT_FALSE(check.contradicts(law, time_from_seconds(2.0)));  // nothing since
  law.offset = 0.1;                                              // too small for the ring to tell
  EXPECT_FALSE(check.contradicts(law, time_from_seconds(1.0)));
  (void)look(1.0, 0.5, room);
  law.offset = 0.5;
  EXPECT_FALSE(check.contradicts(law, time_from_seconds(1.0)));
}

TEST_F(RingCheckTest, WhatGivesNoEchoTakesTheLastOneAway) {
  (void)look(1.0, 0.0, room);
  ring.hear(2.0, RoomForTest{}, {}, {});
  for (const RingEcho& echo : ring.echoes.all()) EXPECT_EQ(echo.range, 0.0);
}

}  // namespace
}  // namespace docent::collision_avoidance::ring_check_test
