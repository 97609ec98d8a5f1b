#include "docent/simulator/traced/outlines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "docent/base/random.h"

namespace docent::simulator {
namespace {

struct Drawn {
  GridFrame frame;
  std::vector<bool> cells;
};

/// Rows from the top; '#' is set. Cells of a metre.
Drawn draw(const std::vector<std::string>& rows) {
  Drawn drawn;
  drawn.frame.resolution = 1.0;
  drawn.frame.columns = static_cast<int>(rows.front().size());
  drawn.frame.rows = static_cast<int>(rows.size());
  for (auto row = rows.rbegin(); row != rows.rend(); ++row) {
    for (const char c : *row) drawn.cells.push_back(c == '#');
  }
  return drawn;
}

TEST(Outlines, OfARoomWithAPillar) {
  const Drawn room = draw({"......",  //
                           ".####.",  //
                           ".#.##.",  //
                           ".####.",  //
                           "......"});
  const auto outlines = trace_outlines(room.frame, room.cells);
  ASSERT_EQ(outlines.size(), 2U);
  EXPECT_EQ(outlines[0], (Polygon{{1, 1}, {5, 1}, {5, 4}, {1, 4}}));
  EXPECT_NEAR(signed_area(outlines[1]), -1.0, 1e-12);
  EXPECT_EQ(outlines[1].size(), 4U);
}

TEST(Outlines, CellsThatTouchByACornerAreJoined) {
  Drawn drawn = draw({"#..",  //
                      ".#.",  //
                      "..#"});
  join_corners(drawn.frame, drawn.cells);
  const auto outlines = trace_outlines(drawn.frame, drawn.cells);
  ASSERT_EQ(outlines.size(), 1U);
  EXPECT_TRUE(is_simple(outlines[0]));
}

TEST(Outlines, HoldExactlyTheSetCellsWhateverTheyAre) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Rng rng{seed};
    Drawn drawn;
    drawn.frame.resolution = 0.5;
    drawn.frame.columns = 14;
    drawn.frame.rows = 11;
    for (std::size_t i = 0; i < drawn.frame.size(); ++i) drawn.cells.push_back(rng.chance(0.5));
    join_corners(drawn.frame, drawn.cells);
    double area = 0.0;
    const auto outlines = trace_outlines(drawn.frame, drawn.cells);
    for (const Polygon& outline : outlines) {
      EXPECT_TRUE(is_simple(outline)) << seed;
      area += signed_area(outline);
    }
    const auto set = std::count(drawn.cells.begin(), drawn.cells.end(), true);
    EXPECT_NEAR(area, 0.25 * static_cast<double>(set), 1e-9) << seed;
  }
}

TEST(Outlines, SimplifiedAStairBecomesALine) {
  Polygon stair{{0, 0}, {10, 0}};
  for (int i = 0; i < 40; ++i) {
    stair.push_back({10 - 0.25 * i, 0.25 * i + 0.25});
    stair.push_back({10 - 0.25 * (i + 1), 0.25 * i + 0.25});
  }
  const Polygon line = simplified(stair, 0.2);
  EXPECT_LE(line.size(), 5U);
  EXPECT_NEAR(signed_area(line), 50.0, 2.0);
}

TEST(Outlines, SimplifiedStaysSimpleAndNear) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Rng rng{seed};
    Polygon star;
    for (int i = 0; i < 60; ++i) star.push_back(rng.uniform(1.0, 3.0) * unit(Angle::degrees(6.0 * i)));
    const double tolerance = rng.uniform(0.05, 0.8);
    const Polygon result = simplified(star, tolerance);
    EXPECT_TRUE(is_simple(result)) << seed;
    for (const Point2 corner : star) EXPECT_LE(outline_distance(result, corner), tolerance + 1e-9) << seed;
  }
}

}  // namespace
}  // namespace docent::simulator
