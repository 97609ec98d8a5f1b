#include "docent/localization/beam_choice/beam_origin.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace docent::localization::beam_origin_test {
namespace {

constexpr double kMaxRange = 10.0;

/// A room of 8 x 8 m with walls a cell thick, and unknown land to the left of x = 1.
OccupancyGrid room() {
  OccupancyGrid map;
  map.frame = {160, 160, 0.05, {0.0, 0.0}};
  map.cells.assign(map.frame.size(), OccupancyGrid::kFree);
  for (int row = 0; row < 160; ++row) {
    for (int column = 0; column < 160; ++column) {
      const bool is_wall = row == 0 || row == 159 || column == 159;
      auto& cell = map.cells[map.frame.index({column, row})];
      if (is_wall) cell = OccupancyGrid::kOccupied;
      if (column < 20) cell = OccupancyGrid::kUnknown;
    }
  }
  return map;
}

std::vector<BeliefMode> at(double x, double y, double mass = 1.0) { return {{{x, y, Angle{}}, {}, mass}}; }

sensor_models::RangeSweep ahead(double range) { return {{{0.0, range, false}}}; }

TEST(BeamOrigin, ToldByRangeAndClearance) {
  const sensor_models::RayCaster caster{room()};
  const auto origin = [&](double range) {
    return beam_origins(caster, at(4.0, 4.0), ahead(range), {}, kMaxRange, {})[0];
  };
  EXPECT_EQ(origin(2.0), sensor_models::BeamOrigin::not_map);
  EXPECT_EQ(origin(3.95), sensor_models::BeamOrigin::map);
  EXPECT_EQ(origin(3.80), sensor_models::BeamOrigin::map) << "within the noise";
  EXPECT_EQ(origin(4.5), sensor_models::BeamOrigin::map) << "longer than expected: nobody";
  EXPECT_EQ(beam_origins(caster, at(4.0, 4.0), {{{0.0, 10.0, true}}}, {}, kMaxRange, {})[0],
            sensor_models::BeamOrigin::unknown);
  EXPECT_EQ(beam_origins(caster, {}, ahead(2.0), {}, kMaxRange, {})[0], sensor_models::BeamOrigin::unknown)
      << "a lost robot";
  const sensor_models::RangeSweep back{{{std::numbers::pi, 2.0, false}}};
  EXPECT_EQ(beam_origins(caster, at(4.0, 4.0), back, {}, kMaxRange, {})[0], sensor_models::BeamOrigin::unknown)
      << "unknown land";
}

TEST(BeamOrigin, NearAWallItMayBeTheWall) {
  const sensor_models::RayCaster caster{room()};
  // Along the lower wall: short of the far wall, but beside the near one.
  EXPECT_EQ(beam_origins(caster, at(4.0, 0.17), ahead(2.0), {}, kMaxRange, {})[0],
            sensor_models::BeamOrigin::maybe_map);
  EXPECT_EQ(beam_origins(caster, at(4.0, 0.08), ahead(2.0), {}, kMaxRange, {})[0], sensor_models::BeamOrigin::map);
}

TEST(BeamOrigin, WhatEndsAtAWallIsTheWallAcrossUnknownLand) {
  OccupancyGrid map = room();
  for (int row = 0; row < 160; ++row) map.cells[map.frame.index({10, row})] = OccupancyGrid::kOccupied;
  const sensor_models::RayCaster caster{map};
  const double to_wall = 4.0 - 0.525;
  const sensor_models::RangeSweep back{{{std::numbers::pi, to_wall, false}, {std::numbers::pi, to_wall - 0.3, false}}};
  const auto origins = beam_origins(caster, at(4.0, 4.0), back, {}, kMaxRange, {});
  EXPECT_EQ(origins[0], sensor_models::BeamOrigin::map);
  EXPECT_EQ(origins[1], sensor_models::BeamOrigin::unknown) << "short of the wall, and nobody knows what is there";
}

TEST(BeamOrigin, ShorterIsAveragedOverTheModes) {
  const sensor_models::RayCaster caster{room()};
  auto modes = at(4.0, 4.0, 0.8);
  modes.push_back({{6.9, 4.0, Angle{}}, {}, 0.2});  // there, the wall is where the beam ends
  const auto shorter = shorter_probability(caster, modes, {0.0, 1.05, false}, kMaxRange, {});
  ASSERT_TRUE(shorter.has_value());
  EXPECT_NEAR(*shorter, 0.8 + 0.2 * 0.5, 0.1);
  EXPECT_EQ(beam_origins(caster, modes, ahead(1.05), {}, kMaxRange, {})[0], sensor_models::BeamOrigin::map)
      << "not sure enough";
}

TEST(BeamOrigin, EntropyFilterAsksTheGain) {
  const sensor_models::RayCaster caster{room()};
  PersonFilterParams params;
  params.filter = "entropy";
  const std::vector<float> confuses{0.5F};
  const std::vector<float> helps{-0.5F};
  EXPECT_EQ(beam_origins(caster, at(4.0, 4.0), ahead(2.0), confuses, kMaxRange, params)[0],
            sensor_models::BeamOrigin::not_map);
  EXPECT_EQ(beam_origins(caster, at(4.0, 4.0), ahead(2.0), helps, kMaxRange, params)[0],
            sensor_models::BeamOrigin::map);
  params.filter = "none";
  EXPECT_EQ(beam_origins(caster, at(4.0, 4.0), ahead(2.0), confuses, kMaxRange, params)[0],
            sensor_models::BeamOrigin::map);
}

TEST(BeamOrigin, FaultsNameTheField) {
  PersonFilterParams params;
  EXPECT_TRUE(params.validate().has_value());
  params.filter = "novelty";
  EXPECT_FALSE(params.validate().has_value());
  params = {};
  params.gamma = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(params.validate().error().message.find("gamma"), std::string::npos);
}

}  // namespace
}  // namespace docent::localization::beam_origin_test
