#include "docent/collision_avoidance/plausibility/near_things.h"

#include <gtest/gtest.h>

#include <limits>
#include <optional>
#include <vector>

#include "docent/collision_avoidance/expected_sweeps/room_for_test.h"

namespace docent::collision_avoidance::near_things_test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// A scanner drives at a thing; it says that nothing is there of what is nearer than `blind`.
class NearThingsTest : public ::testing::Test {
 protected:
  void drive(double from, double to, double blind, double step = 0.04) {
    for (double x = from; x <= to; x += step) look({x, 0.0, {}}, blind);
  }
  void look(const Pose2& at, double blind) {
    time += period;
    sweep = room.sweep(time, at);
    for (float& range : sweep.ranges)
      if (range < blind) range = kInfinity;
    const SweepView view = view_of(sweep, at);
    if (before) {
      std::vector<float> expected;
      expect(*before, inverse(at) * before->odom_from_sensor, view, expected);
      things.add(*before, view, expected, form_of(sweep, std::max(sweep.min_range, things.blind_within()), limits));
    }
    before = view;
    hidden = things.hidden_in(sweep, at).size();
  }
  RoomForTest room;
  BaseLimits limits;
  NearThings things;
  std::optional<SweepView> before;
  SensorSweep sweep;
  double time = 0.0;
  double period = 0.1;  ///< [s] between sweeps
  std::size_t hidden = 0;
};

TEST_F(NearThingsTest, HoldsAWallThatHasGoneWithinMinRange) {
  room.min_range = 0.5;
  room.walls = {{{2.0, -3.0}, {2.0, 3.0}}};
  drive(0.0, 1.44, 0.5);
  EXPECT_FALSE(things.is_any_sure());
  drive(1.48, 1.7, 0.5);
  EXPECT_TRUE(things.is_any_sure());
  EXPECT_GT(hidden, 10U);
  drive(1.7, 1.75, 0.5, 0.005);  // and goes on holding it
  EXPECT_TRUE(things.is_any_sure());
  EXPECT_GT(hidden, 10U);
}

TEST_F(NearThingsTest, HoldsALegWhichGoesAtOnce) {
  room.min_range = 0.5;
  room.discs = {{{2.0, 0.0}, 0.08}};
  drive(0.0, 1.6, 0.5);
  EXPECT_TRUE(things.is_any_sure());
  EXPECT_GE(hidden, 3U);
  // It walks away, and a wall is seen beyond.
  room.discs.clear();
  room.walls = {{{4.0, -3.0}, {4.0, 3.0}}};
  for (int i = 0; i < 4; ++i) look({1.6, 0.0, {}}, 0.5);
  EXPECT_EQ(hidden, 0U);
  EXPECT_FALSE(things.is_any_sure());
}

TEST_F(NearThingsTest, FindsAScannerThatIsBlindFartherThanItStates) {
  room.min_range = 0.05;
  room.walls = {{{2.0, -3.0}, {2.0, 3.0}}};
  drive(0.0, 1.7, 0.6);
  EXPECT_TRUE(things.is_any_sure());
  EXPECT_NEAR(things.blind_within(), 0.62, 0.06);
  EXPECT_GT(hidden, 10U);
}

TEST_F(NearThingsTest, LegsThatComeAndGoBetweenOthersAreNoBlindness) {
  room.min_range = 0.05;
  const std::vector<std::pair<Point2, double>> two{{{0.8, 0.2}, 0.06}, {{0.8, -0.2}, 0.06}};
  const auto stand = [&](bool with_third) {
    room.discs.clear();
    for (const auto& [at, radius] : two) room.discs.push_back({at, radius});
    if (with_third) room.discs.push_back({{0.78, 0.0}, 0.12});
  };
  room.discs = {{{0.45, 0.1}, 0.06}};  // somebody has been nearer
  for (int i = 0; i < 3; ++i) look({}, 0.05);
  for (int k = 0; k < 10; ++k) {
    stand(true);
    for (int i = 0; i < 3; ++i) look({}, 0.05);
    stand(false);
    for (int i = 0; i < 3; ++i) look({}, 0.05);
  }
  EXPECT_EQ(things.blind_within(), 0.0);
  EXPECT_FALSE(things.is_any_sure());
}

TEST_F(NearThingsTest, TakesBackABlindnessWhereItSeesAfterAll) {
  room.min_range = 0.05;
  room.walls = {{{2.0, -3.0}, {2.0, 3.0}}};
  drive(0.0, 1.7, 0.6);
  ASSERT_GT(things.blind_within(), 0.5);
  room.walls.clear();
  room.discs = {{{2.05, 0.0}, 0.06}};
  for (int i = 0; i < 3; ++i) look({1.7, 0.0, {}}, 0.05);
  EXPECT_EQ(things.blind_within(), 0.0);
  EXPECT_EQ(hidden, 0U);
}

TEST_F(NearThingsTest, BetweenSlowSweepsAnybodyMayHaveLeft) {
  period = 1.0;
  room.min_range = 0.5;
  room.discs = {{{2.0, 0.0}, 0.08}};
  drive(0.0, 1.6, 0.5);
  EXPECT_EQ(hidden, 0U);
  EXPECT_FALSE(things.is_any_sure());
}

TEST_F(NearThingsTest, SomebodyWhoStepsAsideIsNotHeld) {
  room.min_range = 0.15;
  for (int i = 0; i < 20; ++i) {
    room.discs = {{{0.62, -0.8 + 0.12 * i}, 0.25}};
    look({}, 0.15);
    EXPECT_EQ(hidden, 0U) << i;
    EXPECT_FALSE(things.is_any_sure()) << i;
  }
}

TEST_F(NearThingsTest, WhatTheRingHearsIsThereThoughTheScannerNeverSawIt) {
  const std::vector<Point2> heard{{0.4, 0.0}, {0.4, 0.1}};
  room.min_range = 0.5;
  for (int i = 0; i < 6; ++i) {
    look({}, 0.5);
    things.hear(view_of(room.sweep(5.0 + 0.1 * i, {}), {}), heard, true);
  }
  EXPECT_TRUE(things.is_any_sure());
}

TEST_F(NearThingsTest, ALowStoolInAHallIsNotWhatAScannerLeavesOut) {
  const std::vector<Point2> heard{{0.4, 0.0}, {0.4, 0.1}};
  room.min_range = 0.05;  // it says that it would see it, and has not
  for (int i = 0; i < 6; ++i) {
    look({}, 0.05);
    things.hear(view_of(room.sweep(5.0 + 0.1 * i, {}), {}), heard, false);
  }
  EXPECT_FALSE(things.is_any_sure());
}

}  // namespace
}  // namespace docent::collision_avoidance::near_things_test
