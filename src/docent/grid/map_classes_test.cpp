#include "docent/grid/map_classes.h"

#include <gtest/gtest.h>

namespace docent {
namespace {

TEST(MapClasses, SuspiciousClassesAreNamed) {
  OccupancyGrid map;
  map.frame = {20, 10, 0.1, {}};
  map.cells.assign(200, OccupancyGrid::kUnknown);
  EXPECT_NE(classes_of(map).warning().find("nothing is free"), std::string::npos);
  for (int column = 5; column < 15; ++column) map.cells[map.frame.index({column, 5})] = OccupancyGrid::kFree;
  EXPECT_NE(classes_of(map).warning().find("nothing is occupied"), std::string::npos);
  map.cells[map.frame.index({4, 5})] = OccupancyGrid::kOccupied;
  EXPECT_EQ(classes_of(map).warning(), "");
  EXPECT_EQ(classes_of(map).text(), "5 % free, 94.5 % unknown, 0.5 % occupied");
  for (auto& cell : map.cells)
    if (cell == OccupancyGrid::kUnknown) cell = OccupancyGrid::kFree;  // the slab
  EXPECT_NE(classes_of(map).warning().find("up to the picture's edge"), std::string::npos);
}

}  // namespace
}  // namespace docent
