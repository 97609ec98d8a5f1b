#include "docent/collision_avoidance/plausibility/map_check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "docent/collision_avoidance/expected_sweeps/room_for_test.h"

namespace docent::collision_avoidance::map_check_test {
namespace {

/// A hall of 12 x 8 m with a case in it, and its map.
class MapCheckTest : public ::testing::Test {
 protected:
  MapCheckTest() {
    room.box(0, 0, 12, 8);
    room.box(6, 3, 7, 4);
    OccupancyGrid grid;
    grid.frame = {260, 180, 0.05, {-0.5, -0.5}};
    grid.cells.assign(grid.frame.size(), OccupancyGrid::kFree);
    for (const Segment& wall : room.walls) {
      const double length = distance(wall.a, wall.b);
      for (double along = 0.0; along <= length; along += 0.02)
        grid.cells[grid.frame.index(grid.frame.cell_at(wall.a + (along / length) * (wall.b - wall.a)))] =
            OccupancyGrid::kOccupied;
    }
    map = std::make_shared<const OccupancyGrid>(grid);
  }
  /// @param believed  where it believes to be, `at` in truth
  MapCheck::Finding look(const Pose2& at, const Pose2& believed, double scale, double offset, double mass = 0.9) {
    MapCheck check{known_walls(map)};
    MapCheck::Finding found;
    for (int i = 0; i < 4; ++i) {
      SensorSweep sweep = room.sweep(1.0 + 0.3 * i, at);
      for (float& range : sweep.ranges)
        if (range < sweep.max_range) range = static_cast<float>(scale * static_cast<double>(range) + offset);
      check.believe(sweep.stamp, believed, mass);
      found = check.compare(view_of(sweep, {})).value_or(found);
    }
    return found;
  }
  RoomForTest room;
  std::shared_ptr<const OccupancyGrid> map;
};

TEST_F(MapCheckTest, AScannerInOrderIsAtItsPlace) {
  const Pose2 at{3.0, 2.0, Angle::degrees(30)};
  const auto found = look(at, at, 1.0, 0.0);
  EXPECT_TRUE(found.is_known);
  EXPECT_TRUE(found.in_order);
  EXPECT_TRUE(found.fits);
  EXPECT_FALSE(found.lie);
  EXPECT_FALSE(look(at, at, 1.0, 0.0, 0.1).is_known);  // it may be anywhere
}

TEST_F(MapCheckTest, RaysPassWhatMayBeFreeAndEndWhereTheMapDoesNotSay) {
  const Pose2 at{3.0, 2.0, {}};
  OccupancyGrid grid = *map;
  for (double x = 4.0; x < 5.0; x += 0.02)  // between free and occupied
    grid.cells[grid.frame.index(grid.frame.cell_at({x, 2.0}))] = 40;
  for (double x = 3.8; x < 4.2; x += 0.02)
    for (double y = 2.8; y < 3.2; y += 0.02)
      grid.cells[grid.frame.index(grid.frame.cell_at({x, y}))] = OccupancyGrid::kUnknown;
  MapCheckParams params;
  params.every = 1;
  MapCheck check{known_walls(std::make_shared<const OccupancyGrid>(grid)), params};
  const SensorSweep sweep = room.sweep(1.0, at);
  const SweepView view = view_of(sweep, at);
  check.believe(sweep.stamp, {}, 0.9);
  ASSERT_TRUE(check.compare(view));
  const auto expected_along = [&](Point2 ray) {
    return check.expected()[static_cast<std::size_t>(view.sample_to(ray))];
  };
  EXPECT_NEAR(expected_along({1.0, 0.0}), 9.0, 0.1);
  EXPECT_TRUE(std::isnan(expected_along({1.0, 1.0})));
}

TEST_F(MapCheckTest, FindsLawsAtManyPlaces) {
  for (const Pose2& at : {Pose2{3.0, 2.0, Angle::degrees(30)}, Pose2{9.0, 5.5, Angle::degrees(200)}}) {
    for (const double offset : {-0.4, 0.5, 1.0}) {
      const auto found = look(at, at, 1.0, offset);
      ASSERT_TRUE(found.lie) << offset;
      EXPECT_NEAR(found.lie->offset, offset, 0.1);
    }
    const auto twice = look(at, at, 2.0, 0.0);
    ASSERT_TRUE(twice.lie);
    EXPECT_NEAR(twice.lie->scale, 2.0, 0.1);
  }
}

TEST_F(MapCheckTest, AWrongPlaceIsNoLie) {
  for (const Pose2& off : {Pose2{0.5, 0.0, {}}, Pose2{0.0, -0.4, {}}, Pose2{0.0, 0.0, Angle::degrees(9)},
                           Pose2{4.0, 2.0, Angle::degrees(90)}}) {
    for (const Pose2& at : {Pose2{3.0, 2.0, Angle::degrees(30)}, Pose2{3.0, 5.0, Angle::degrees(0)}})
      EXPECT_FALSE(look(at, at * off, 1.0, 0.0).lie) << off.x << " " << off.y;
  }
}

TEST_F(MapCheckTest, SaysWhereNothingIsWithinReach) {
  room.max_range = 1.5;
  const Pose2 at{3.0, 4.0, {}};
  EXPECT_TRUE(look(at, at, 1.0, 0.0).is_nothing_near);
  const Pose2 near{1.0, 4.0, Angle::degrees(180)};
  EXPECT_FALSE(look(near, near, 1.0, 0.0).is_nothing_near);
}

TEST_F(MapCheckTest, AMapThatDoesNotKnowThePlaceSaysNothing) {
  const Pose2 at{3.0, 4.0, {}};
  OccupancyGrid unknown = *map;
  std::fill(unknown.cells.begin(), unknown.cells.end(), OccupancyGrid::kUnknown);
  for (const OccupancyGrid& grid : {unknown, OccupancyGrid{}}) {
    map = std::make_shared<const OccupancyGrid>(grid);
    EXPECT_FALSE(look(at, at, 1.0, 0.0).is_known);
  }
}

}  // namespace
}  // namespace docent::collision_avoidance::map_check_test
