#include "docent/grid/occupancy_grid.h"

#include <gtest/gtest.h>

#include <limits>

#include "docent/base/random.h"

namespace docent {
namespace {

TEST(Grid, CoarseCellsAreOccupiedIfAnyIs) {
  OccupancyGrid map;
  map.frame = {4, 2, 0.05, {0, 0}};
  map.cells = {0, 0, -1, -1, 0, 100, -1, -1};
  const auto coarse = coarsened(map, 2);
  EXPECT_EQ(coarse.cells, (std::vector<std::int8_t>{100, -1}));
}

TEST(DistanceTransform, EqualsTheSlowTwin) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    Rng rng{seed};
    const GridFrame frame{static_cast<int>(rng.integer(1, 30)), static_cast<int>(rng.integer(1, 30)), 0.1, {0, 0}};
    std::vector<bool> occupied(frame.size());
    for (std::size_t i = 0; i < occupied.size(); ++i) occupied[i] = rng.chance(0.05);
    const auto fast = distance_transform(frame, occupied);
    for (int row = 0; row < frame.rows; ++row) {
      for (int column = 0; column < frame.columns; ++column) {
        double least = std::numeric_limits<double>::infinity();
        for (int r = 0; r < frame.rows; ++r) {
          for (int c = 0; c < frame.columns; ++c) {
            if (occupied[frame.index({c, r})]) least = std::min(least, 0.1 * std::hypot(c - column, r - row));
          }
        }
        const auto found = static_cast<double>(fast[frame.index({column, row})]);
        if (std::isinf(least)) {
          EXPECT_TRUE(std::isinf(found)) << "seed " << seed;
        } else {
          EXPECT_NEAR(found, least, 1e-5) << "seed " << seed;
        }
      }
    }
  }
}

}  // namespace
}  // namespace docent
