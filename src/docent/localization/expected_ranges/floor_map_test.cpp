#include "docent/localization/expected_ranges/floor_map.h"

#include <gtest/gtest.h>

#include <vector>

#include "docent/localization/expected_ranges/state_space.h"

namespace docent::localization {
namespace {

OccupancyGrid hall() {
  OccupancyGrid map;
  map.frame = {100, 60, 0.1, {-1.0, 2.0}};
  map.cells.assign(map.frame.size(), OccupancyGrid::kFree);
  for (int column = 0; column < 100; ++column) map.cells[static_cast<std::size_t>(column)] = OccupancyGrid::kOccupied;
  return map;
}

TEST(FloorMap, NobodyStandsInAStaircaseThatLasersLookAcross) {
  const OccupancyGrid map = hall();
  const std::vector<Polygon> stairs{{{2.0, 4.0}, {5.0, 4.0}, {5.0, 6.0}, {2.0, 6.0}},
                                    {{-9.0, 0.0}, {-5.0, 0.0}, {-5.0, 9.0}}};
  const FloorMap floor{map, stairs};
  EXPECT_EQ(floor.walls.cells, map.cells);
  const StateSpace everywhere{map, sensor_models::RayCaster{map}, {}};
  const StateSpace space{floor.standing, sensor_models::RayCaster{floor.walls}, {}};
  const auto place_at = [](const StateSpace& of, Point2 point) { return of.place_at(of.frame().cell_at(point)); };
  EXPECT_NE(place_at(everywhere, {3.5, 5.0}), StateSpace::kNoPlace);
  EXPECT_EQ(place_at(space, {3.5, 5.0}), StateSpace::kNoPlace);
  EXPECT_NE(place_at(space, {5.5, 5.0}), StateSpace::kNoPlace);
  const double closed = static_cast<double>(everywhere.places() - space.places()) * 0.15 * 0.15;
  EXPECT_NEAR(closed, 6.0, 0.8);
}

TEST(FloorMap, WithNothingClosedItIsTheMap) {
  const OccupancyGrid map = hall();
  const FloorMap floor{map};
  EXPECT_EQ(floor.standing.cells, map.cells);
}

}  // namespace
}  // namespace docent::localization
