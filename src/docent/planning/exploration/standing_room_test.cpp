#include "docent/planning/exploration/standing_room.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace docent::planning {
namespace {

OccupancyGrid free_floor(int columns, int rows, Point2 origin) {
  OccupancyGrid map;
  map.frame = {columns, rows, 0.05, origin};
  map.cells.assign(map.frame.size(), OccupancyGrid::kFree);
  return map;
}

TEST(StandingRoom, MeasuresTheBorderAsItsOutlineLies) {
  const Polygon area{{0.31, 0.22}, {3.7, 0.4}, {3.5, 2.9}, {2.1, 2.7}, {2.0, 1.1}, {1.7, 1.2}, {1.6, 3.3}, {0.2, 3.1}};
  const OccupancyGrid map = free_floor(90, 80, {-0.2, -0.13});
  constexpr double kReach = 0.6;
  const StandingRoom room{map, area, kReach};
  for (int row = 0; row < map.frame.rows; ++row) {
    for (int column = 0; column < map.frame.columns; ++column) {
      const Point2 at = map.frame.centre({column, row});
      const double border = room.best_in({column, row}, 1, 0.0).border;
      if (contains(area, at)) {
        EXPECT_NEAR(border, std::min(kReach, outline_distance(area, at)), 1e-5) << at.x << ", " << at.y;
      } else {
        EXPECT_LT(border, 0.0) << at.x << ", " << at.y;
      }
    }
  }
}

TEST(StandingRoom, ADoorIsAsWideWhereverTheGridLies) {
  // A door of 16 cells, 0.8 m, in a wall; planning cells are two wide, so they lie to it in one way or the other.
  for (const int first : {20, 21}) {
    OccupancyGrid map = free_floor(60, 20, {});
    for (int column = 0; column < 60; ++column) {
      if (column >= first && column < first + 16) continue;
      map.cells[map.frame.index({column, 10})] = OccupancyGrid::kOccupied;
    }
    const StandingRoom room{map, {}, 0.6};
    double most = 0.0;
    for (int column = 0; column < 30; ++column) most = std::max(most, room.best_in({column, 5}, 2, 0.0).walls);
    EXPECT_GE(most, 0.4) << first;
  }
}

TEST(StandingRoom, BorderAndWallsBothCount) {
  OccupancyGrid map = free_floor(20, 20, {});
  for (int row = 0; row < 20; ++row) map.cells[map.frame.index({0, row})] = OccupancyGrid::kOccupied;
  const Polygon area{{-1.0, -1.0}, {0.5, -1.0}, {0.5, 2.0}, {-1.0, 2.0}};
  const StandingRoom room{map, area, 0.6};
  const auto at = [&](double beyond) { return room.best_in({1, 2}, 4, beyond).at.x; };  // cells at 0.225 to 0.375
  EXPECT_NEAR(at(0.0), 0.275, 1e-9) << "0.25 m from the wall, 0.225 m from the border";
  EXPECT_NEAR(at(0.3), 0.375, 1e-9) << "the border alone may be near";
}

}  // namespace
}  // namespace docent::planning
