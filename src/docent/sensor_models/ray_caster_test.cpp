#include "docent/sensor_models/ray_caster.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "docent/base/random.h"

namespace docent::sensor_models {
namespace {

/// First row is the top. '#' occupied, '?' unknown, anything else free; cells of 1 m.
OccupancyGrid drawn(const std::vector<std::string>& rows, double resolution = 1.0) {
  OccupancyGrid map;
  map.frame = {static_cast<int>(rows[0].size()), static_cast<int>(rows.size()), resolution, {}};
  for (auto row = rows.rbegin(); row != rows.rend(); ++row)
    for (const char c : *row)
      map.cells.push_back(c == '#'   ? OccupancyGrid::kOccupied
                          : c == '?' ? OccupancyGrid::kUnknown
                                     : OccupancyGrid::kFree);
  return map;
}

/// The slow, obvious twin: walk in tiny steps.
std::optional<double> walked(const OccupancyGrid& map, Point2 from, Point2 direction, double max_range,
                             double allowance) {
  constexpr double kStep = 0.0005;
  double unknown = 0.0;
  for (double way = 0.0; way < max_range; way += kStep) {
    const CellIndex cell = map.frame.cell_at(from + way * direction);
    if (!map.frame.holds(cell)) return std::nullopt;
    if (map.is_occupied(cell)) return way;
    if (!map.is_free(cell)) unknown += kStep;
    if (unknown > allowance) return std::nullopt;
  }
  return max_range;
}

TEST(RayCaster, KnowsTheAnswersInASmallRoom) {
  const RayCaster caster{drawn({"########", "#      #", "#      ?", "#      #", "########"})};
  EXPECT_DOUBLE_EQ(caster.cast({1.5, 2.5}, {0.0, 1.0}, 10.0, 0.3).value(), 1.5);
  EXPECT_DOUBLE_EQ(caster.cast({1.5, 2.5}, {-1.0, 0.0}, 10.0, 0.3).value(), 0.5);
  EXPECT_FALSE(caster.cast({1.5, 2.5}, {1.0, 0.0}, 10.0, 0.3).has_value());      // out through the unknown
  EXPECT_DOUBLE_EQ(caster.cast({1.5, 2.5}, {1.0, 0.0}, 4.0, 0.3).value(), 4.0);  // not that far
  EXPECT_DOUBLE_EQ(caster.cast({3.5, 1.5}, {1.0, 0.0}, 10.0, 0.3).value(), 3.5);
  EXPECT_EQ(caster.cast({0.5, 0.5}, {1.0, 0.0}, 10.0, 0.3).value(), 0.0);     // inside the wall
  EXPECT_FALSE(caster.cast({-3.0, 0.5}, {1.0, 0.0}, 10.0, 0.3).has_value());  // outside the map
}

TEST(RayCaster, AgreesWithWalkingInSmallSteps) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng{seed};
    std::vector<std::string> rows(40, std::string(60, ' '));
    for (int i = 0; i < 60; ++i)
      rows[static_cast<std::size_t>(rng.integer(0, 39))][static_cast<std::size_t>(rng.integer(0, 59))] =
          rng.chance(0.8) ? '#' : '?';
    const OccupancyGrid map = drawn(rows, 0.1);
    const RayCaster caster{map};
    for (int i = 0; i < 40; ++i) {
      const Point2 from{rng.uniform(0.0, 6.0), rng.uniform(0.0, 4.0)};
      const Point2 towards = unit(Angle::radians(rng.uniform(-3.14, 3.14)));
      const auto expected = walked(map, from, towards, 5.0, 0.15);
      const auto found = caster.cast(from, towards, 5.0, 0.15);
      ASSERT_EQ(found.has_value(), expected.has_value());
      if (found) {
        EXPECT_NEAR(*found, *expected, 0.0011);
      }
    }
  }
}

}  // namespace
}  // namespace docent::sensor_models
