#include "docent/collision_avoidance/plausibility/bent_walls.h"

#include <gtest/gtest.h>

#include <cmath>

#include "docent/collision_avoidance/expected_sweeps/room_for_test.h"

namespace docent::collision_avoidance::bent_walls_test {
namespace {

/// A robot that turns once on the spot, or drives.
class BentWallsTest : public ::testing::Test {
 protected:
  BentWallsTest() {
    room.box(-3, -2.5, 4, 3);
    room.discs = {{{2.0, 2.0}, 0.25}, {{3.0, -1.5}, 0.25}};
  }
  /// @returns the offset that is found within `seconds` of a turn at half a radian a second
  std::optional<double> turn(double offset, double seconds = 12.0, double scale = 1.0) {
    for (int i = 0; i < static_cast<int>(10.0 * seconds); ++i) {
      const Pose2 at{0.02 * i * way, 0.0, Angle::radians(0.05 * i)};
      SensorSweep sweep = room.sweep(1.0 + 0.1 * i, at);
      for (float& range : sweep.ranges) range = static_cast<float>(scale * range + offset);
      if (const auto found = walls.add(view_of(sweep, at))) return found;
    }
    return std::nullopt;
  }
  RoomForTest room;
  double way = 0.0;
  BentWalls walls;
};

TEST_F(BentWallsTest, AnOffsetShowsBeforeTheTurnIsOver) {
  for (const double offset : {0.5, 0.3, -0.4}) {
    walls.forget();
    const auto found = turn(offset);
    ASSERT_TRUE(found) << offset;
    EXPECT_NEAR(*found, offset, 0.08);
  }
}

TEST_F(BentWallsTest, WallsOfAScannerInOrderAreStraight) {
  EXPECT_FALSE(turn(0.0));
  EXPECT_TRUE(walls.are_straight());
  EXPECT_FALSE(turn(0.0, 12.0, 2.0));  // a factor bends nothing
}

TEST_F(BentWallsTest, ARoundHallIsBentByAnotherOffsetFromElsewhere) {
  room.walls.clear();
  for (int i = 0; i < 90; ++i) {
    const Point2 from = 4.0 * unit(Angle::degrees(4.0 * i));
    const Point2 to = 4.0 * unit(Angle::degrees(4.0 * i + 4.0));
    room.walls.push_back({from, to});
  }
  room.discs.clear();
  EXPECT_FALSE(turn(0.0));
  way = 1.0;
  EXPECT_FALSE(turn(0.0));
}

TEST_F(BentWallsTest, PeopleAllRoundAreNoWalls) {
  room.walls.clear();
  room.discs.clear();
  for (int i = 0; i < 16; ++i) {
    const double far = i % 3 == 0 ? 1.4 : i % 3 == 1 ? 1.8 : 2.3;
    room.discs.push_back({far * unit(Angle::degrees(22.5 * i)), 0.25});
  }
  EXPECT_FALSE(turn(0.0));
}

}  // namespace
}  // namespace docent::collision_avoidance::bent_walls_test
