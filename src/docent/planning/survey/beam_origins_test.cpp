#include "docent/planning/survey/beam_origins.h"

#include <gtest/gtest.h>

#include <numbers>

namespace docent::planning::beam_origins_test {
namespace {

using sensor_models::BeamOrigin;

/// 4 m of free floor about the middle, with a wall in the east; nobody has looked beyond.
OccupancyGrid some_floor() {
  OccupancyGrid map;
  map.frame = {200, 200, 0.05, {-5.0, -5.0}};
  map.cells.assign(map.frame.size(), OccupancyGrid::kUnknown);
  for (int row = 60; row < 140; ++row)
    for (int column = 60; column < 140; ++column)
      map.cells[map.frame.index({column, row})] = column == 139 ? OccupancyGrid::kOccupied : OccupancyGrid::kFree;
  return map;
}

TEST(BeamOrigins, ABeamIsAskedOfTheMap) {
  sensor_models::RangeSweep sweep;
  sweep.beams = {{0.0, 1.0, false}, {0.0, 1.96, false}, {1.57, 4.0, false}, {3.0, 1.0, true}};
  const auto origins = beam_origins(some_floor(), sweep, {});
  ASSERT_EQ(origins.size(), 4U);
  EXPECT_EQ(origins[0], BeamOrigin::not_map) << "on floor that was free";
  EXPECT_EQ(origins[1], BeamOrigin::map);
  EXPECT_EQ(origins[2], BeamOrigin::unknown) << "nobody has looked there";
  EXPECT_EQ(origins[3], BeamOrigin::unknown) << "nothing came back";
}

TEST(BeamOrigins, ItIsSeenFromWhereTheRobotStands) {
  sensor_models::RangeSweep sweep;
  sweep.beams = {{0.0, 1.0, false}};
  EXPECT_EQ(beam_origins(some_floor(), sweep, {0.95, 0.0, {}}).front(), BeamOrigin::map);
  EXPECT_EQ(beam_origins(some_floor(), sweep, {0.95, 0.0, Angle::radians(std::numbers::pi)}).front(),
            BeamOrigin::not_map);
}

TEST(BeamOrigins, WithoutAMapNothingIsKnown) {
  sensor_models::RangeSweep sweep;
  sweep.beams = {{0.0, 1.0, false}};
  EXPECT_EQ(beam_origins({}, sweep, {}).front(), BeamOrigin::unknown);
}

}  // namespace
}  // namespace docent::planning::beam_origins_test
