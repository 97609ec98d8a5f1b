#include "docent/localization/belief/pose_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "docent/base/random.h"

namespace docent::localization {
namespace {

constexpr double kRadians = std::numbers::pi / 180.0;

/// A corridor of 30 x 2.4 m with a door every three metres, recessed by 20 cm and no two of a width: 5 cm cells.
OccupancyGrid corridor(bool has_doors = true) {
  OccupancyGrid map;
  map.frame = {600, 60, 0.05, {}};
  map.cells.assign(map.frame.size(), OccupancyGrid::kFree);
  for (int row = 0; row < 60; ++row) {
    for (int column = 0; column < 600; ++column) {
      const bool is_door = has_doors && column % 60 < 12 + column / 60;
      const bool is_wall = row < (is_door ? 2 : 6) || row >= 54 || column < 2 || column >= 598;
      if (is_wall) map.cells[map.frame.index({column, row})] = OccupancyGrid::kOccupied;
    }
  }
  return map;
}

sensor_models::RangeSweep sweep_at(const sensor_models::RayCaster& caster, const Pose2& truth, Rng& rng) {
  sensor_models::RangeSweep sweep;
  for (int degree = -90; degree <= 90; ++degree) {
    const Angle bearing = Angle::degrees(degree);
    const double range = *caster.cast(truth.position(), unit(truth.theta + bearing), 40.0, 0.3) + 0.025;
    sweep.beams.push_back({bearing.radians(), range + rng.normal(0.0, 0.02), false});
  }
  return sweep;
}

TEST(BestPoseNear, FindsThePlaceInACorridorThatOdometryMissedByHalfAMetre) {
  const OccupancyGrid map = corridor();
  const sensor_models::RayCaster caster{map};
  Rng rng{3};
  for (int trial = 0; trial < 60; ++trial) {
    const Pose2 truth{rng.uniform(5, 25), rng.uniform(1.2, 1.8), Angle::radians(rng.normal(0.0, 0.1))};
    const PoseGuess guess{{truth.x + rng.uniform(-0.6, 0.6), truth.y + rng.uniform(-0.2, 0.2),
                           truth.theta + Angle::radians(rng.uniform(-0.1, 0.1))},
                          0.35,
                          0.06};
    const FoundPose result = best_pose_near(std::span{&guess, 1}, sweep_at(caster, truth, rng), caster, 30.0, 30.0);
    const Pose2& found = result.map_from_robot;
    EXPECT_GT(result.share, 0.8) << trial;
    EXPECT_LT(distance(found.position(), truth.position()), 0.15) << trial;
    EXPECT_LT(std::abs((found.theta - truth.theta).radians()), 2.0 * kRadians) << trial;
  }
}

TEST(BestPoseNear, SearchesAboutEveryGuessAndStaysWhereReadingsTellNothing) {
  const OccupancyGrid map = corridor();
  const sensor_models::RayCaster caster{map};
  Rng rng{4};
  const Pose2 truth{12.3, 1.5, Angle{}};
  const std::vector<PoseGuess> guesses{{{16.0, 1.5, Angle{}}, 0.2, 0.05}, {{12.0, 1.5, Angle{}}, 0.2, 0.05}};
  const sensor_models::RangeSweep sweep = sweep_at(caster, truth, rng);
  EXPECT_LT(distance(best_pose_near(guesses, sweep, caster, 30.0, 30.0).map_from_robot.position(), truth.position()),
            0.15);
  sensor_models::RangeSweep few;
  few.beams.assign(sweep.beams.begin(), sweep.beams.begin() + 9);
  const FoundPose nothing = best_pose_near(guesses, few, caster, 30.0, 30.0);
  EXPECT_EQ(nothing.map_from_robot.x, 16.0);
  EXPECT_EQ(nothing.share, 0.0);
}

TEST(BestPoseNear, IsNotSureOfThePlaceAlongAPlainCorridor) {
  const OccupancyGrid map = corridor(false);
  const sensor_models::RayCaster caster{map};
  Rng rng{5};
  const Pose2 truth{15.0, 1.5, Angle{}};
  const PoseGuess guess{{15.3, 1.5, Angle{}}, 0.7, 0.05};
  sensor_models::RangeSweep sides = sweep_at(caster, truth, rng);  // the ends of the corridor are out of sight
  std::erase_if(sides.beams, [](const sensor_models::SweepBeam& beam) { return beam.range > 10.0; });
  EXPECT_LT(best_pose_near(std::span{&guess, 1}, sides, caster, 30.0, 30.0).share, 0.6);
}

}  // namespace
}  // namespace docent::localization
