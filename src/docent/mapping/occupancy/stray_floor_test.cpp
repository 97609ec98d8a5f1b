#include "docent/mapping/occupancy/stray_floor.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace docent::mapping::stray_floor_test {
namespace {

OccupancyGrid unknown() {
  OccupancyGrid map;
  map.frame = {60, 40, 0.05, {}};
  map.cells.assign(map.frame.size(), OccupancyGrid::kUnknown);
  return map;
}
void fill(OccupancyGrid& map, CellIndex from, CellIndex to, std::int8_t value) {
  for (int row = from.row; row < to.row; ++row)
    for (int column = from.column; column < to.column; ++column) map.cells[map.frame.index({column, row})] = value;
}

TEST(StrayFloor, SmallPiecesAreForgottenAndLargeOnesStay) {
  OccupancyGrid map = unknown();
  fill(map, {0, 0}, {20, 20}, OccupancyGrid::kFree);       // a room of 1 m2
  fill(map, {20, 0}, {22, 20}, OccupancyGrid::kOccupied);  // its wall
  fill(map, {22, 10}, {60, 11}, OccupancyGrid::kFree);     // a beam behind it
  const OccupancyGrid before = map;
  forget_stray_floor(map, 0.5);
  EXPECT_TRUE(map.is_free({10, 10}));
  EXPECT_TRUE(map.is_occupied({20, 5}));
  EXPECT_EQ(map.at({40, 10}), OccupancyGrid::kUnknown);
  EXPECT_EQ(std::count(map.cells.begin(), map.cells.end(), OccupancyGrid::kOccupied),
            std::count(before.cells.begin(), before.cells.end(), OccupancyGrid::kOccupied));
  OccupancyGrid all = before;
  forget_stray_floor(all, 0.05);
  EXPECT_EQ(all.cells, before.cells) << "a beam of 0.095 m2 is enough then";
}

TEST(StrayFloor, CellsThatMeetAtACornerAreNoPiece) {
  OccupancyGrid map = unknown();
  for (int i = 0; i < 30; ++i) map.cells[map.frame.index({i, i})] = OccupancyGrid::kFree;
  forget_stray_floor(map, 0.01);
  EXPECT_EQ(std::count(map.cells.begin(), map.cells.end(), OccupancyGrid::kFree), 0);
}

}  // namespace
}  // namespace docent::mapping::stray_floor_test
