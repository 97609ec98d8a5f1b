#include "docent/localization/beam_choice/straight_walls.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "docent/base/random.h"

namespace docent::localization::straight_walls_test {
namespace {

std::size_t count(const std::vector<std::uint8_t>& marks) {
  return std::accumulate(marks.begin(), marks.end(), std::size_t{0});
}

/// What a laser sees of the inside of a square room, half a side [m] long from the middle, with noise of 1.5 cm.
sensor_models::RangeSweep square(double half, Rng& rng) {
  sensor_models::RangeSweep sweep;
  for (int degree = -180; degree < 180; ++degree) {
    const double bearing = degree * M_PI / 180.0;
    const double range = half / std::max(std::abs(std::cos(bearing)), std::abs(std::sin(bearing)));
    sweep.beams.push_back({bearing, range + 0.015 * rng.normal(), false});
  }
  return sweep;
}

TEST(StraightWalls, ARoomIsNothingElse) {
  Rng rng{3};
  EXPECT_GT(count(on_straight_walls(square(4.0, rng))), 340U);
}

TEST(StraightWalls, ShortOnesDoNotCount) {
  Rng rng{3};
  EXPECT_EQ(count(on_straight_walls(square(0.6, rng))), 0U);
}

TEST(StraightWalls, ACrowdHasNone) {
  Rng rng{4};
  for (int trial = 0; trial < 20; ++trial) {
    sensor_models::RangeSweep crowd;
    double range = 2.0;
    for (int degree = -180; degree < 180; ++degree) {
      if (degree % 6 == 0) range = rng.uniform(0.6, 4.0);  // the next person
      crowd.beams.push_back({degree * M_PI / 180.0, range + 0.05 * rng.normal(), false});
    }
    EXPECT_EQ(count(on_straight_walls(crowd)), 0U);
  }
}

TEST(StraightWalls, AGapEndsAWall) {
  Rng rng{5};
  sensor_models::RangeSweep sweep = square(4.0, rng);
  for (std::size_t i = 0; i < sweep.beams.size(); ++i) sweep.beams[i].no_return = i % 12 == 0;
  EXPECT_EQ(count(on_straight_walls(sweep)), 0U);  // pieces of 0.8 m
}

TEST(StraightWalls, AWallIsOneAcrossTheEndOfTheSweep) {
  Rng rng{6};
  sensor_models::RangeSweep behind;
  for (int degree = -180; degree < 180; ++degree) {
    const double bearing = degree * M_PI / 180.0;
    const bool is_wall = std::abs(degree) > 180 - 40;  // 1 m behind, 1.7 m long, the end in its middle
    behind.beams.push_back({bearing, is_wall ? -1.0 / std::cos(bearing) + 0.01 * rng.normal() : 10.0, !is_wall});
  }
  EXPECT_GT(count(on_straight_walls(behind)), 75U);
}

TEST(StraightWalls, EmptySweepsAreEmpty) { EXPECT_TRUE(on_straight_walls({}).empty()); }

}  // namespace
}  // namespace docent::localization::straight_walls_test
