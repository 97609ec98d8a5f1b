#include "docent/grid/clearance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace docent {
namespace {

constexpr double kRadius = 0.265;  // [m]

/// 6 x 4 m, free.
OccupancyGrid hall() {
  OccupancyGrid map;
  map.frame = {120, 80, 0.05, {0, 0}};
  map.cells.assign(map.frame.size(), 0);
  return map;
}

/// Most room [m] beside the way along y = 2 at this x.
double most_room(const std::vector<double>& spare, const GridFrame& frame, double x) {
  double most = -1e9;
  for (double y = 0.05; y < 4.0; y += 0.1) most = std::max(most, spare[frame.index(frame.cell_at({x, y}))]);
  return most;
}

TEST(Clearance, TheBorderBindsTheCentreAndHazardsTheBody) {
  const Clearance clearance;
  const OccupancyGrid map = hall();
  const GridFrame frame = coarse_frame(map.frame, 1);
  for (double half = 0.05; half < 1.0; half += 0.05) {
    const Polygon area{{0, 2 - half}, {6, 2 - half}, {6, 2 + half}, {0, 2 + half}};
    const std::vector<Polygon> beside{{{2, 0}, {4, 0}, {4, 2 - half}, {2, 2 - half}},
                                      {{2, 2 + half}, {4, 2 + half}, {4, 4}, {2, 4}}};
    const auto of_area = spare_room(map, {}, area, kRadius, clearance, 1);
    const auto of_hazards = spare_room(map, beside, {}, kRadius, clearance, 1);
    EXPECT_NEAR(most_room(of_area, frame, 3.0), half - clearance.border, 0.051) << half;
    EXPECT_NEAR(most_room(of_hazards, frame, 3.0), half - clearance.hazards - kRadius, 0.051) << half;
  }
}

TEST(Clearance, NothingIsOpenOutsideTheArea) {
  const OccupancyGrid map = hall();
  const GridFrame frame = coarse_frame(map.frame, 3);
  const auto spare = spare_room(map, {}, {{1, 1}, {5, 1}, {5, 3}, {1, 3}}, kRadius, {}, 3);
  EXPECT_LT(spare[frame.index(frame.cell_at({0.5, 2}))], 0.0);
  EXPECT_GT(spare[frame.index(frame.cell_at({3, 2}))], 0.0);
  EXPECT_LT(spare[frame.index(frame.cell_at({3, 1.1}))], 0.0);
}

}  // namespace
}  // namespace docent
