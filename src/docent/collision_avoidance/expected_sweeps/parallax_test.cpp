#include "docent/collision_avoidance/expected_sweeps/parallax.h"

#include <gtest/gtest.h>

#include <cmath>

#include "docent/collision_avoidance/expected_sweeps/room_for_test.h"

namespace docent::collision_avoidance::parallax_test {
namespace {

using Finding = ParallaxCheck::Finding;

/// A scanner that drives through a room.
class ParallaxTest : public ::testing::Test {
 protected:
  ParallaxTest() {
    room.box(-2, -3, 4, 3.5);
    room.discs = {{{1.5, 1.0}, 0.25}, {{2.0, -1.2}, 0.15}};
  }
  SweepView view(const Pose2& place, double scale, double offset) {
    SensorSweep sweep = room.sweep(time += 0.1, place);
    for (float& range : sweep.ranges) range = static_cast<float>(scale * static_cast<double>(range) + offset);
    return view_of(sweep, place);
  }
  std::optional<ParallaxOffset> seen(double offset, const Pose2& moved, const Pose2& said, double scale = 1.0) {
    const Pose2 from{-1.0, 0.2, Angle::degrees(10)};
    return offset_by_parallax(view(from, scale, offset), view(from * moved, scale, offset), inverse(said));
  }
  /// What is said on so much way, from pose to pose.
  Finding drive(double scale, double offset, double way, double turn_rate = 0.0) {
    Finding last = Finding::nothing;
    for (int k = 0; k < std::lround(way / 0.01); ++k) {
      const Finding found = check.add(view(at, scale, offset));
      if (found != Finding::nothing) last = found;
      at = at * Pose2{0.01, 0.0, Angle::radians(0.01 * turn_rate)};
    }
    return last;
  }
  RoomForTest room;
  ParallaxCheck check;
  Pose2 at{-1.0, 0.2, Angle::degrees(10)};
  double time = 1.0;
};

TEST_F(ParallaxTest, AQuarterOfAMetreTellsTheOffset) {
  const Pose2 moved{0.25, 0.0, Angle::degrees(3)};
  for (const double offset : {-0.4, 0.0, 0.3, 0.5, 1.0}) {
    const auto found = seen(offset, moved, moved);
    ASSERT_TRUE(found) << offset;
    EXPECT_LE(found->error, 0.15) << offset;
    EXPECT_NEAR(found->offset, offset, 0.05 + 3.0 * found->error) << offset;
    EXPECT_GE(found->share, 0.8) << offset;
  }
}

TEST_F(ParallaxTest, WheelsThatSlipAndMountsThatAreWrongAreNoOffset) {
  const Pose2 moved{0.25, 0.0, Angle::degrees(3)};
  for (const Pose2& said : {Pose2{0.29, 0.0, Angle::degrees(3)}, Pose2{0.22, 0.0, Angle::degrees(4)},
                            Pose2{0.246, 0.043, Angle::degrees(3)}}) {
    const auto found = seen(0.0, moved, said);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->offset, 0.0, 0.05 + 3.0 * found->error) << said.x << " " << said.y;
  }
}

TEST_F(ParallaxTest, ATurnOnTheSpotTellsNothing) {
  for (const double offset : {0.0, 0.5}) {
    const Pose2 turned{0.0, 0.0, Angle::degrees(20)};
    const auto found = seen(offset, turned, turned);
    if (found) {
      EXPECT_GE(found->error, 0.15) << offset;
    }
  }
}

TEST_F(ParallaxTest, AnOffsetIsNamedWithinSomeDecimetres) {
  for (const double offset : {-0.6, 0.5, 0.8}) {
    check.forget();
    at = {-1.0, 0.2, Angle::degrees(10)};
    EXPECT_EQ(drive(1.0, offset, 0.35), Finding::offset) << offset;
    EXPECT_NEAR(check.offset(), offset, 0.15);
  }
}

TEST_F(ParallaxTest, WhoTurnsFirstIsToldFromWhereHeDrivesOn) {
  for (int k = 0; k < 36; ++k) {
    at.theta = Angle::degrees(10.0 * k);
    EXPECT_EQ(check.add(view(at, 1.0, 0.5)), Finding::nothing);
  }
  EXPECT_EQ(drive(1.0, 0.5, 0.35), Finding::offset);
}

TEST_F(ParallaxTest, AScannerThatWasInOrderIsNotBlamedAnyMore) {
  EXPECT_EQ(drive(1.0, 0.0, 0.6, 0.5), Finding::in_order);
  EXPECT_EQ(drive(1.0, 0.5, 0.6), Finding::nothing);
}

TEST_F(ParallaxTest, PeopleWhoWalkAreNoOffset) {
  for (int seed = 1; seed <= 20; ++seed) {
    room.rng = Rng{static_cast<std::uint64_t>(seed)};
    check.forget();
    for (int k = 0; k < 60; ++k) {  // at 0.1 m/s, among seven who walk
      room.discs.clear();
      for (int person = 0; person < 7; ++person) {
        const double way = 0.1 * k * (0.4 + 0.1 * person);
        const Point2 from{-1.0 + 0.6 * person, person % 2 == 0 ? 2.5 : -2.0};
        room.discs.push_back(
            {from + (person % 2 == 0 ? -way : way) * unit(Angle::degrees(90.0 + 10.0 * seed * person)), 0.22});
      }
      EXPECT_NE(check.add(view({-1.0 + 0.01 * k, 0.2, Angle::degrees(20)}, 1.0, 0.0)), Finding::offset)
          << seed << " " << k;
    }
  }
}

TEST_F(ParallaxTest, ARoundHallIsInOrder) {
  room = {};
  for (int i = 0; i < 72; ++i) {
    const auto corner = [](int k) { return 5.0 * unit(Angle::degrees(5.0 * k)); };
    room.walls.push_back({corner(i), corner(i + 1)});
  }
  at = {-2.0, 1.0, Angle::degrees(30)};
  EXPECT_NE(drive(1.0, 0.0, 2.0, 0.3), Finding::offset);
}

}  // namespace
}  // namespace docent::collision_avoidance::parallax_test
