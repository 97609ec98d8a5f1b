#include "docent/collision_avoidance/expected_sweeps/wall_shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "docent/collision_avoidance/expected_sweeps/room_for_test.h"

namespace docent::collision_avoidance::wall_shape_test {
namespace {

using Finding = WallShape::Finding;

class WallShapeTest : public ::testing::Test {
 protected:
  /// What is found in 3 s of turning in place, with all ranges `offset` too long.
  Finding turn(double offset) {
    WallShape shape;
    Finding found = Finding::nothing;
    for (int i = 0; i < 30; ++i) {
      SensorSweep sweep = room.sweep(1.0 + 0.1 * i, {0.0, 0.0, Angle::radians(0.06 * i)});
      for (float& range : sweep.ranges)
        if (range < sweep.max_range) range = std::max(0.0F, range + static_cast<float>(offset));
      const Finding now = shape.add(view_of(sweep, {}));
      if (now != Finding::nothing) found = now;
      found_offset = shape.offset();
      if (found == Finding::bent) break;
    }
    return found;
  }
  RoomForTest room;
  double found_offset = 0.0;
};

TEST_F(WallShapeTest, StraightWallsAreStraight) {
  room.box(-4, -2, 5, 3);
  EXPECT_EQ(turn(0.0), Finding::straight);
  EXPECT_EQ(turn(0.08), Finding::straight);
}

TEST_F(WallShapeTest, AnOffsetBendsThem) {
  room.box(-4, -2, 5, 3);
  room.discs = {{{1.5, 1.0}, 0.2}, {{-1.0, -1.2}, 0.2}};
  for (const double offset : {0.5, 0.35, -0.5}) {
    EXPECT_EQ(turn(offset), Finding::bent) << offset;
    EXPECT_NEAR(found_offset, offset, 0.16);
  }
}

TEST_F(WallShapeTest, WhatIsRoundIsNotStraightByAnyOffset) {
  const auto ring = [&](double x, double radius) {
    for (int i = 0; i < 72; ++i) {
      const auto corner = [&](int k) {
        return Point2{x, 0.3} + radius * unit(Angle::radians(2.0 * std::numbers::pi * k / 72));
      };
      room.walls.push_back({corner(i), corner(i + 1)});
    }
  };
  ring(0.8, 3.0);
  EXPECT_NE(turn(0.0), Finding::bent);
  room.walls.clear();
  ring(2.5, 1.2);  // a great column
  ring(-3.0, 1.5);
  EXPECT_NE(turn(0.0), Finding::bent);
}

}  // namespace
}  // namespace docent::collision_avoidance::wall_shape_test
