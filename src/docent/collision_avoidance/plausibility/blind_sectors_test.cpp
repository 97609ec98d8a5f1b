#include "docent/collision_avoidance/plausibility/blind_sectors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>

#include "docent/collision_avoidance/expected_sweeps/room_for_test.h"

namespace docent::collision_avoidance::blind_sectors_test {
namespace {

class Sectors : public ::testing::Test {
 protected:
  Sectors() { room.box(-3, -3, 3, 3); }
  SweepView look(std::size_t from = 0, std::size_t end = 0) {
    time += 0.1;
    SensorSweep sweep = room.sweep(time, {});
    for (std::size_t i = from; i < end; ++i) sweep.ranges[i] = std::numeric_limits<float>::infinity();
    return view_of(sweep, {});
  }
  void judge(const SweepView& view) {
    sectors.follow(view);
    if (before) {
      std::vector<float> expected;
      expect(*before, {}, view, expected);
      sectors.look_for(view, expected, 0.1);
    }
    before = view;
  }
  RoomForTest room;
  double time = 0.0;
  BlindSectors sectors;
  std::optional<SweepView> before;
};

TEST_F(Sectors, WhereAWallWasASilentSectorIsBlindUntilItAnswers) {
  for (int i = 0; i < 3; ++i) judge(look());
  EXPECT_TRUE(sectors.runs().empty());
  judge(look(60, 110));
  ASSERT_EQ(sectors.runs().size(), 1U);
  EXPECT_FALSE(sectors.is_any_sure());  // believed no more at once, named when it lasts
  for (int i = 0; i < 3; ++i) judge(look(60, 110));
  EXPECT_TRUE(sectors.is_any_sure());
  ASSERT_EQ(sectors.runs().size(), 1U);
  EXPECT_NEAR(static_cast<double>(sectors.runs()[0].first), 60.0, 1.0);
  EXPECT_NEAR(static_cast<double>(sectors.runs()[0].end), 110.0, 1.0);
  for (int i = 0; i < 3; ++i) judge(look());
  EXPECT_TRUE(sectors.runs().empty());
}

TEST_F(Sectors, WhatBeganWhenItWasCarriedOffIsForgotten) {
  for (int i = 0; i < 3; ++i) judge(look());
  for (int i = 0; i < 2; ++i) judge(look(60, 110));
  ASSERT_EQ(sectors.runs().size(), 1U);
  sectors.forget_newest();
  EXPECT_TRUE(sectors.runs().empty());
  for (int i = 0; i < 3; ++i) judge(look());
  for (int i = 0; i < 6; ++i) judge(look(60, 110));
  sectors.forget_newest();
  EXPECT_TRUE(sectors.is_any_sure());  // it has been blind for longer
}

TEST_F(Sectors, ASilenceOfOneSweepIsNotNamed) {
  for (int i = 0; i < 3; ++i) judge(look());
  judge(look(60, 110));
  judge(look());
  EXPECT_TRUE(sectors.runs().empty());
  EXPECT_FALSE(sectors.is_any_sure());
}

TEST_F(Sectors, ABlackCoatAndAPersonWhoLeavesAreNone) {
  for (int i = 0; i < 3; ++i) judge(look());
  for (int i = 0; i < 5; ++i) judge(look(60, 70));  // 10 degrees
  EXPECT_TRUE(sectors.runs().empty());
  // Somebody stands close before nothing, and steps aside at 2 m/s.
  room.walls.clear();
  room.box(-30, -30, 30, 30);
  before.reset();
  for (int i = 0; i < 10; ++i) {
    room.discs = {{{0.6, 0.2 * i}, 0.25}};
    judge(look());
    EXPECT_TRUE(sectors.runs().empty()) << i;
  }
}

TEST_F(Sectors, WhatWasAtTheEndOfTheReachMayGoOut) {
  room.walls.clear();
  room.box(-9.5, -9.5, 9.5, 9.5);
  for (int i = 0; i < 3; ++i) judge(look());
  for (int i = 0; i < 3; ++i) judge(look(70, 110));
  EXPECT_TRUE(sectors.runs().empty());
}

}  // namespace
}  // namespace docent::collision_avoidance::blind_sectors_test
