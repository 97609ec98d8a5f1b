#include "docent/grid/turned.h"

#include <gtest/gtest.h>

#include <cmath>

namespace docent {
namespace {

TEST(Turned, AWallOfOneCellStaysWhole) {
  OccupancyGrid map;
  map.frame = {80, 60, 0.05, {0.2, -0.4}};
  map.cells.assign(map.frame.size(), OccupancyGrid::kFree);
  for (int column = 10; column < 70; ++column) map.cells[map.frame.index({column, 30})] = OccupancyGrid::kOccupied;
  for (double angle = -3.1; angle < 3.1; angle += 0.17) {
    const OccupancyGrid to = turned(map, angle);
    for (double x = map.frame.centre({10, 30}).x; x <= map.frame.centre({69, 30}).x; x += 0.01) {
      const double y = map.frame.centre({10, 30}).y;
      const Point2 at{std::cos(angle) * x - std::sin(angle) * y, std::sin(angle) * x + std::cos(angle) * y};
      bool is_near = false;
      for (const double dx : {-0.03, 0.0, 0.03})
        for (const double dy : {-0.03, 0.0, 0.03}) is_near |= to.is_occupied(to.frame.cell_at({at.x + dx, at.y + dy}));
      EXPECT_TRUE(is_near) << angle << " " << x;
    }
  }
}

TEST(Turned, OutsideIsUnknown) {
  OccupancyGrid map;
  map.frame = {10, 10, 0.1, {}};
  map.cells.assign(100, OccupancyGrid::kFree);
  const OccupancyGrid to = turned(map, 0.7854);
  EXPECT_EQ(to.at({0, 0}), OccupancyGrid::kUnknown);
  EXPECT_EQ(to.at(to.frame.cell_at({0.0, 0.7})), OccupancyGrid::kFree);
  EXPECT_NEAR(to.frame.columns, 15, 1);
}

}  // namespace
}  // namespace docent
