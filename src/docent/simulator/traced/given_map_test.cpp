#include "docent/simulator/traced/given_map.h"

#include <gtest/gtest.h>

#include "docent/base/random.h"
#include "docent/simulator/traced/traced_museum.h"
#include "docent/simulator/world/survey.h"

namespace docent::simulator {
namespace {

constexpr double kCell = 0.05;  // [m]

/// A hall of 14 x 10 m, and east of it a room of 3 x 3 m behind a gap of 0.6 m.
OccupancyGrid hall_and_closet() {
  OccupancyGrid map;
  map.frame = {360, 220, kCell, {-1.0, 2.0}};
  map.cells.assign(map.frame.size(), OccupancyGrid::kUnknown);
  const auto fill = [&](int left, int below, int right, int above, std::int8_t value) {
    for (int row = below; row < above; ++row)
      for (int column = left; column < right; ++column) map.cells[map.frame.index({column, row})] = value;
  };
  fill(8, 8, 292, 212, OccupancyGrid::kOccupied);
  fill(10, 10, 290, 210, OccupancyGrid::kFree);
  fill(290, 98, 354, 162, OccupancyGrid::kOccupied);
  fill(292, 100, 352, 160, OccupancyGrid::kFree);
  fill(290, 120, 292, 132, OccupancyGrid::kFree);
  return map;
}

TEST(GivenMap, ARoomBehindANarrowGapStaysARoom) {
  const OccupancyGrid given = hall_and_closet();
  const auto traced = trace_museum(given, {}, "hall", 3);
  ASSERT_TRUE(traced) << traced.error().message;
  const OccupancyGrid surveyed = survey(traced->plan.world, {}, Rng{3}.stream("survey")).map;
  const OccupancyGrid map = with_given_map(given, traced->frame, traced->building, surveyed);
  const auto at = [&](const OccupancyGrid& of, int column, int row) {
    return of.at(of.frame.cell_at(given.frame.centre({column, row})));
  };
  EXPECT_NE(at(surveyed, 320, 130), OccupancyGrid::kFree) << "the world has no such room";
  EXPECT_EQ(at(map, 320, 130), OccupancyGrid::kFree);
  EXPECT_EQ(at(map, 291, 126), OccupancyGrid::kFree) << "nothing stands in the gap";
  EXPECT_EQ(at(map, 353, 130), OccupancyGrid::kOccupied);
  EXPECT_EQ(at(map, 0, 0), OccupancyGrid::kUnknown);
  // What was furnished stands on it.
  int furnished = 0;
  for (int row = 12; row < 208; ++row)
    for (int column = 12; column < 288; ++column) furnished += at(map, column, row) == OccupancyGrid::kOccupied ? 1 : 0;
  EXPECT_GT(furnished, 20);
}

}  // namespace
}  // namespace docent::simulator
