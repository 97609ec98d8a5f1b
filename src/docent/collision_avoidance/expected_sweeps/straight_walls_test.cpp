#include "docent/collision_avoidance/expected_sweeps/straight_walls.h"

#include <gtest/gtest.h>

#include <cmath>

#include "docent/collision_avoidance/expected_sweeps/room_for_test.h"

namespace docent::collision_avoidance::straight_walls_test {
namespace {

using Finding = StraightWallsCheck::Finding;

/// A scanner that drives through a room.
class StraightWallsTest : public ::testing::Test {
 protected:
  StraightWallsTest() {
    room.box(-2, -3, 4, 3.5);
    room.discs = {{{1.5, 1.0}, 0.25}, {{2.0, -1.2}, 0.15}};
  }
  SweepView view(const Pose2& at, double scale = 1.0, double offset = 0.0) {
    SensorSweep sweep = room.sweep(time += 0.1, at);
    for (float& range : sweep.ranges) range = static_cast<float>(scale * static_cast<double>(range) + offset);
    return view_of(sweep, at);
  }
  /// The last finding of sweeps on so much way.
  Finding drive(double scale, double offset, double way = 0.9) {
    Finding last = Finding::nothing;
    for (int k = 0; k < std::lround(way / 0.1); ++k) {
      const double x = -1.0 + 0.1 * (k % 20 < 10 ? k % 10 : 9 - k % 10);  // to and fro
      const Finding found = check.add(view({x, 0.2, Angle::degrees(10)}, scale, offset));
      if (found != Finding::nothing) last = found;
    }
    return last;
  }
  RoomForTest room;
  StraightWallsCheck check;
  double time = 1.0;
};

TEST_F(StraightWallsTest, EachLongWallOfOneSweepTellsAnOffset) {
  for (const double offset : {-0.4, 0.0, 0.3, 0.5, 1.0}) {
    const auto pieces = straight_walls_of(view({-1.0, 0.2, {}}, 1.0, offset));
    ASSERT_GE(pieces.size(), 2U) << offset;
    for (const WallPiece& piece : pieces) EXPECT_NEAR(piece.offset, offset, 0.05 + 3.0 * piece.error) << offset;
  }
}

TEST_F(StraightWallsTest, AFactorLeavesWallsStraight) {
  for (const WallPiece& piece : straight_walls_of(view({-1.0, 0.2, {}}, 2.0, 0.0)))
    EXPECT_NEAR(piece.offset, 0.0, 0.05 + 3.0 * piece.error);
}

TEST_F(StraightWallsTest, AScannerInOrderIsSaidToBe) { EXPECT_EQ(drive(1.0, 0.0), Finding::in_order); }

TEST_F(StraightWallsTest, AnOffsetIsFoundInSomeDecimetresOfWay) {
  EXPECT_EQ(drive(1.0, 0.5), Finding::offset);
  EXPECT_NEAR(check.offset(), 0.5, 0.1);
  check.forget();
  EXPECT_EQ(drive(1.0, 0.0), Finding::in_order);
}

TEST_F(StraightWallsTest, AScannerThatWasInOrderIsNotBlamedAnyMore) {
  EXPECT_EQ(drive(1.0, 0.0), Finding::in_order);
  EXPECT_NE(drive(1.0, 0.5, 9.0), Finding::offset);
}

TEST_F(StraightWallsTest, ABentWallIsNoOffset) {
  room = {};
  for (int i = 0; i < 72; ++i) {  // a round hall
    const auto corner = [](int k) { return 5.0 * unit(Angle::degrees(5.0 * k)); };
    room.walls.push_back({corner(i), corner(i + 1)});
  }
  for (int k = 0; k < 30; ++k)
    EXPECT_NE(check.add(view({-2.0 + 0.1 * k, 1.0, Angle::degrees(10.0 * k)})), Finding::offset) << k;
}

TEST_F(StraightWallsTest, OneWallAndPeopleTellNothing) {
  room = {};
  room.walls.push_back({{3.0, -6.0}, {3.0, 6.0}});
  room.discs = {{{1.5, 1.0}, 0.25}, {{1.0, -1.2}, 0.25}, {{2.0, 2.0}, 0.25}};
  for (int k = 0; k < 10; ++k) {
    EXPECT_EQ(check.add(view({-1.0 + 0.1 * k, 0.2, {}})), Finding::nothing);
    EXPECT_EQ(check.add(view({-1.0 + 0.1 * k, 0.2, {}}, 1.0, 0.5)), Finding::nothing);
  }
}

}  // namespace
}  // namespace docent::collision_avoidance::straight_walls_test
