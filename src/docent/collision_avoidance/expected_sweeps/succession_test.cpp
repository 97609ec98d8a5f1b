#include "docent/collision_avoidance/expected_sweeps/succession.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "docent/collision_avoidance/expected_sweeps/room_for_test.h"

namespace docent::collision_avoidance::succession_test {
namespace {

using Finding = Succession::Finding;

/// A scanner in a furnished room, ten sweeps a second.
class Followed : public ::testing::Test {
 protected:
  Followed() {
    room.box(-4, -3, 8, 4);
    room.discs = {{{2.0, 2.0}, 0.3}, {{3.5, -1.5}, 0.25}, {{6.0, 1.8}, 0.25}};
  }
  /// Seen from `at`, where odometry has it at `odom`.
  Finding see(const Pose2& at, const Pose2& odom) {
    time += step;
    return succession.add(view_of(room.sweep(time, at), odom));
  }
  Finding see(const Pose2& at) { return see(at, at); }
  RoomForTest room;
  Succession succession{BaseLimits{}};
  double time = 1.0;
  double step = 0.1;
};

TEST_F(Followed, ARobotThatDrivesAndTurnsAsItsOdometrySaysFollows) {
  Pose2 at;
  EXPECT_EQ(see(at), Finding::untold) << "the first one";
  for (int i = 0; i < 60; ++i) {
    at = at * Pose2{i < 30 ? 0.08 : 0.0, 0.0, Angle::radians(i < 30 ? 0.0 : 0.12)};
    EXPECT_EQ(see(at), Finding::follows) << i;
  }
}

TEST_F(Followed, WhatTheBaseCanDoIsNoBreakWhateverOdometrySays) {
  Pose2 at;
  see(at);
  for (int i = 0; i < 30; ++i) {
    at = at * Pose2{0.06, 0.0, Angle::radians(0.08)};  // odometry stands still: wheels that are frozen, or turn freely
    EXPECT_NE(see(at, {}), Finding::broken) << i;
  }
  for (int i = 0; i < 10; ++i) EXPECT_EQ(see(at, Pose2{0.06 * i, 0.0, Angle{}}), Finding::follows) << "it slips";
}

TEST_F(Followed, AnotherPlaceBreaksAndTheNextSweepBearsItOut) {
  for (int i = 0; i < 5; ++i) see({0.0, 0.0, Angle{}});
  const Pose2 elsewhere{5.5, 1.0, Angle::degrees(140)};
  EXPECT_EQ(see(elsewhere, {}), Finding::suspect);
  EXPECT_LT(succession.explained(), 0.4);
  EXPECT_EQ(see(elsewhere, {}), Finding::broken);
  EXPECT_EQ(see(elsewhere, {}), Finding::follows) << "from there it goes on";
}

TEST_F(Followed, ATurnAboutOnTheSpotBreaksToo) {
  for (int i = 0; i < 5; ++i) see({2.0, -1.0, Angle{}});
  EXPECT_EQ(see({2.0, -1.0, Angle::degrees(120)}, {2.0, -1.0, Angle{}}), Finding::suspect);
  EXPECT_EQ(see({2.0, -1.0, Angle::degrees(120)}, {2.0, -1.0, Angle{}}), Finding::broken);
}

TEST_F(Followed, LateAndDoubledAndSwappedSweepsFollow) {
  std::vector<SweepView> seen;
  Pose2 at;
  for (int i = 0; i < 20; ++i) {
    at = at * Pose2{0.05, 0.0, Angle::radians(0.11)};
    time += 0.1;
    seen.push_back(view_of(room.sweep(time, at), at));
  }
  for (std::size_t i = 4; i < seen.size(); ++i) {
    SweepView late = seen[i - (i % 3)];  // 0, 0.1 and 0.2 s late, by stamp and by the pose of then
    late.stamp = seen[i].stamp;
    late.odom_from_sensor = seen[i].odom_from_sensor;
    EXPECT_NE(succession.add(late), Finding::broken) << i;
  }
}

TEST_F(Followed, PeopleAllRoundWhoWalkAreNoBreak) {
  room.discs.clear();
  for (int i = 0; i < 14; ++i) room.discs.push_back({2.0 * unit(Angle::degrees(-91.0 + 14.0 * i)), 0.25});
  for (int i = 0; i < 100; ++i) {
    for (std::size_t k = 0; k < room.discs.size(); ++k) {
      const Angle way = Angle::degrees(47.0 * static_cast<double>(k) + 3.0 * i);
      room.discs[k].centre = room.discs[k].centre + 0.12 * unit(way);
      if (norm(room.discs[k].centre) < 0.6)
        room.discs[k].centre = (0.7 / norm(room.discs[k].centre)) * room.discs[k].centre;
    }
    EXPECT_NE(see({}), Finding::broken) << i;
  }
}

TEST_F(Followed, OneSweepOfGarbageIsForgottenAndMuchOfItTellsNothing) {
  for (int i = 0; i < 5; ++i) see({});
  SensorSweep garbage = room.sweep(time + 0.1, {});
  Rng rng{5};
  const auto spoil = [&] {
    for (std::size_t i = 0; i < garbage.ranges.size(); ++i)  // in pieces: single beams lie between their neighbours
      garbage.ranges[i] = i % 9 == 0 ? static_cast<float>(rng.uniform(0.3, 9.0)) : garbage.ranges[i - 1];
    time += 0.1;
    garbage.stamp = time_from_seconds(time);
    return succession.add(view_of(garbage, {}));
  };
  EXPECT_EQ(spoil(), Finding::suspect);
  EXPECT_EQ(see({}), Finding::follows);
  for (int i = 0; i < 20; ++i) EXPECT_NE(spoil(), Finding::broken) << i;
}

TEST_F(Followed, TooLittleAndTooLongAgoTellNothing) {
  room.max_range = 1.0;  // nothing in reach
  for (int i = 0; i < 5; ++i) EXPECT_EQ(see({}), Finding::untold);
  room.max_range = 10.0;
  see({});
  step = 1.0;
  EXPECT_EQ(see({5.5, 1.0, Angle::degrees(140)}, {}), Finding::untold);
}

}  // namespace
}  // namespace docent::collision_avoidance::succession_test
