#include "docent/localization/sonar/tracker/sweep_match.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "docent/base/random.h"
#include "docent/localization/sonar/tracker/testing.h"

namespace docent::localization::sweep_match_test {
namespace {

PoseMatrix diagonal(double position, double heading) {
  return {position * position, 0.0, 0.0, 0.0, position * position, 0.0, 0.0, 0.0, heading * heading};
}

/// Echoes of the last metre up to `pose`.
std::vector<PlacedEcho> last_metre(const testing::TurnedRoom& room, const Pose2& pose) {
  std::vector<PlacedEcho> echoes;
  for (const double back : {0.9, 0.6, 0.3, 0.0}) {
    for (const PlacedEcho& echo : room.sweep(pose, {-back, 0.0, Angle{}})) echoes.push_back(echo);
  }
  return echoes;
}

TEST(SweepMatch, FindsThePoseFromAPriorThatIsOff) {
  int matched = 0;
  for (const double turn : {0.0, 19.0, -38.0}) {
    const testing::TurnedRoom room{turn};
    const EchoMap map{room.map};
    Rng rng{7};
    for (int i = 0; i < 12; ++i) {
      const Pose2 truth = room.map_from_room * Pose2{rng.uniform(-1.0, 0.0), rng.uniform(-1.0, 1.0),
                                                     Angle::degrees(rng.uniform(-20.0, 20.0))};
      const Pose2 prior{truth.x + rng.uniform(-0.2, 0.2), truth.y + rng.uniform(-0.2, 0.2),
                        truth.theta + Angle::degrees(rng.uniform(-4.0, 4.0))};
      const SweepMatch match = match_sweep({}, map, last_metre(room, truth), prior, diagonal(0.15, 0.05));
      if (match.outcome == MatchOutcome::ambiguous) continue;
      ASSERT_EQ(match.outcome, MatchOutcome::matched) << turn << ' ' << i;
      ++matched;
      EXPECT_LT(distance(match.map_from_robot.position(), truth.position()), 0.05) << turn << ' ' << i;
      // Smooth walls say little of the heading, but the match knows how little.
      const auto off = difference(match.map_from_robot, truth);
      EXPECT_LT(squared_length(inverse_of(match.covariance), off), 12.0) << turn << ' ' << i;
      EXPECT_LT(match.covariance[0], 0.05 * 0.05);
      EXPECT_GT(match.covariance[0], 0.01 * 0.01) << "never better than the map";
      EXPECT_GT(match.inliers, 0.7);
    }
  }
  EXPECT_GT(matched, 26) << "of 36";
}

TEST(SweepMatch, ShortAndLongReadingsSayNothing) {
  const testing::TurnedRoom room{19.0};
  const EchoMap map{room.map};
  const Pose2 truth = room.map_from_room * Pose2{-0.5, 0.2, Angle::degrees(10.0)};
  const Pose2 prior{truth.x + 0.12, truth.y - 0.1, truth.theta + Angle::degrees(2.0)};
  auto echoes = last_metre(room, truth);
  Rng rng{8};
  for (PlacedEcho& echo : echoes) {
    if (rng.chance(0.3))
      echo.range *= rng.uniform(0.2, 0.8);
    else if (rng.chance(0.1))
      echo.range *= rng.uniform(1.3, 1.8);
  }
  const SweepMatch match = match_sweep({}, map, echoes, prior, diagonal(0.15, 0.05));
  ASSERT_EQ(match.outcome, MatchOutcome::matched);
  EXPECT_LT(distance(match.map_from_robot.position(), truth.position()), 0.06);
}

TEST(SweepMatch, AlongAFeaturelessCorridorThePriorStands) {
  OccupancyGrid grid;
  grid.frame = {600, 60, 0.05, {-15.0, -1.5}};
  grid.cells.assign(grid.frame.size(), OccupancyGrid::kFree);
  for (int column = 0; column < 600; ++column) {
    for (const int row : {9, 50}) grid.cells[grid.frame.index({column, row})] = OccupancyGrid::kOccupied;
  }
  const EchoMap map{grid};
  std::vector<PlacedEcho> echoes;
  const double half = 0.05 * 41 / 2.0;
  for (const double back : {1.0, 0.8, 0.6, 0.4, 0.2, 0.0}) {
    for (const double side : {1.0, -1.0}) {
      for (const double bearing : {75.0, 90.0, 105.0}) {
        const double range = half - 0.25 * std::sin(bearing * std::numbers::pi / 180.0);
        const Point2 place = 0.25 * unit(Angle::degrees(side * bearing));
        echoes.push_back({{place.x - back, place.y, Angle::degrees(side * bearing)}, range});
      }
    }
  }
  const PoseMatrix before = diagonal(0.2, 0.05);
  const SweepMatch match = match_sweep({}, map, echoes, {1.0, 0.13, Angle::degrees(2.0)}, before);
  ASSERT_EQ(match.outcome, MatchOutcome::matched);
  EXPECT_NEAR(match.map_from_robot.y, 0.0, 0.03);
  EXPECT_NEAR(match.map_from_robot.x, 1.0, 0.05);
  EXPECT_NEAR(match.map_from_robot.theta.degrees(), 0.0, 1.0);
  EXPECT_GT(match.covariance[0], 0.8 * before[0]) << "nothing was learned along the corridor";
  EXPECT_LT(match.covariance[4], 0.1 * before[4]);
}

TEST(SweepMatch, RefusesWhatIsUnlikeTheMapAndWhatIsTooLittle) {
  const testing::TurnedRoom room{0.0};
  const EchoMap map{room.map};
  const Pose2 truth = room.map_from_room * Pose2{-0.5, 0.2, Angle{}};
  auto echoes = last_metre(room, truth);
  Rng rng{9};
  for (PlacedEcho& echo : echoes) echo.range = rng.uniform(0.3, 3.5);
  EXPECT_EQ(match_sweep({}, map, echoes, truth, diagonal(0.1, 0.03)).outcome, MatchOutcome::unlike_the_map);
  echoes = room.sweep(truth);
  echoes.resize(8);
  EXPECT_EQ(match_sweep({}, map, echoes, truth, diagonal(0.1, 0.03)).outcome, MatchOutcome::too_few_echoes);
}

TEST(SweepMatch, TwoPlacesThatSoundAlikeAreAmbiguous) {
  // A comb of pillars every 0.5 m along one wall: shifted by half a metre it sounds the same.
  OccupancyGrid grid;
  grid.frame = {600, 60, 0.05, {-15.0, -1.5}};
  grid.cells.assign(grid.frame.size(), OccupancyGrid::kFree);
  for (int column = 0; column < 600; ++column) {
    grid.cells[grid.frame.index({column, 9})] = OccupancyGrid::kOccupied;
    grid.cells[grid.frame.index({column, column % 10 < 4 ? 46 : 50})] = OccupancyGrid::kOccupied;
  }
  const EchoMap map{grid};
  std::vector<PlacedEcho> echoes;
  const Pose2 truth{1.0, 0.0, Angle{}};
  for (int i = 0; i < 20; ++i) {
    for (const double side : {1.0, -1.0}) {
      const Pose2 place{-0.05 * i, side * 0.25, Angle::degrees(side * 90.0)};
      echoes.push_back({place, map.expect(truth * place, 0.17, 5, 5.0)->range});
    }
  }
  SweepMatchParams params;
  params.dependence = 1.0;
  const Pose2 between{1.25, 0.0, Angle{}};
  EXPECT_EQ(match_sweep(params, map, echoes, between, diagonal(0.2, 0.02)).outcome, MatchOutcome::ambiguous);
  EXPECT_EQ(match_sweep(params, map, echoes, {1.03, 0.0, Angle{}}, diagonal(0.03, 0.02)).outcome,
            MatchOutcome::matched);
}

TEST(SweepMatch, RefusesWildParameters) {
  EXPECT_TRUE(SweepMatchParams{}.validate());
  SweepMatchParams params;
  params.dependence = 0.5;
  EXPECT_FALSE(params.validate());
  params = {};
  params.inliers = 1.5;
  EXPECT_FALSE(params.validate());
}

}  // namespace
}  // namespace docent::localization::sweep_match_test
