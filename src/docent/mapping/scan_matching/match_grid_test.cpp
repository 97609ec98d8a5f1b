#include "docent/mapping/scan_matching/match_grid.h"

#include <gtest/gtest.h>

#include "docent/base/random.h"

namespace docent::mapping {
namespace {

std::vector<Point2> drawn_points(std::uint64_t seed, std::size_t count) {
  Rng rng{seed};
  std::vector<Point2> points;
  for (std::size_t i = 0; i < count; ++i) points.push_back({rng.uniform(-3.0, 3.0), rng.uniform(-2.0, 2.0)});
  return points;
}

TEST(MatchGrid, IsFullOnAPointAndFallsBesideIt) {
  const std::vector<Point2> points{{0.0, 0.0}};
  const MatchGrid grid{points, {0.05, 0.10, 1}};
  const CellIndex at = grid.frame().cell_at({0.0, 0.0});
  EXPECT_EQ(grid.bound(0, at), 255);
  EXPECT_NEAR(grid.bound(0, {at.column + 2, at.row}), 255.0 * std::exp(-0.5), 1.0);
  EXPECT_EQ(grid.bound(0, {at.column + 20, at.row}), 0);
}

TEST(MatchGrid, ALevelBoundsAllCellsOfItsSquares) {
  const MatchGrid grid{drawn_points(3, 60), {0.05, 0.07, 5}};
  for (int level = 1; level < grid.levels(); ++level) {
    for (int row = 0; row < grid.frame().rows; row += 3) {
      for (int column = 0; column < grid.frame().columns; column += 3) {
        int most = 0;
        for (int r = row; r < row + (1 << level); ++r) {
          for (int c = column; c < column + (1 << level); ++c) most = std::max<int>(most, grid.bound(0, {c, r}));
        }
        ASSERT_EQ(grid.bound(level, {column, row}), most) << "level " << level << " at " << column << ", " << row;
      }
    }
  }
}

}  // namespace
}  // namespace docent::mapping
