#include "docent/mapping/occupancy/scan_mapper.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "docent/base/random.h"

namespace docent::mapping::scan_mapper_test {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

constexpr double kEast = 4.02;  ///< [m], within a cell and not at its border
constexpr double kNorth = 3.02;

/// What a laser with `beams` readings over 360 degrees sees in a room of 8 x 6 m about the origin.
PlacedSweep in_room(const Pose2& map_from_sensor, int beams) {
  PlacedSweep placed{{}, map_from_sensor};
  for (int i = 0; i < beams; ++i) {
    const double bearing = Angle::radians(2.0 * std::numbers::pi * (i + 0.5) / beams).radians();
    const Point2 along = unit(map_from_sensor.theta + Angle::radians(bearing));
    const double to_x = ((along.x > 0 ? kEast : -kEast) - map_from_sensor.x) / along.x;
    const double to_y = ((along.y > 0 ? kNorth : -kNorth) - map_from_sensor.y) / along.y;
    placed.sweep.beams.push_back({bearing, std::min(to_x, to_y), false});
  }
  return placed;
}

OccupancyGrid map_of(const std::vector<PlacedSweep>& sweeps, const ScanMapperParams& params = {}) {
  ScanMapper mapper{ScanMapper::frame_of(sweeps, params).value(), params};
  for (const PlacedSweep& placed : sweeps) mapper.add(placed);
  return mapper.map();
}

std::int8_t at(const OccupancyGrid& map, Point2 point) { return map.at(map.frame.cell_at(point)); }

TEST(FewestHits, AreAsManyAsTheWayBetweenSweepsBears) {
  const auto hits_at = [](const std::vector<double>& places) {
    std::vector<Pose2> poses;
    for (const double x : places) poses.push_back({x, 1.0, {}});
    return fewest_hits_of(poses);
  };
  EXPECT_EQ(hits_at({}), 1);
  EXPECT_EQ(hits_at({2.0}), 1);
  EXPECT_EQ(hits_at({0.0, 0.1, 0.2}), 3) << "five sweeps of half a metre; never more than three";
  EXPECT_EQ(hits_at({0.0, 0.2, 0.4}), 2);
  EXPECT_EQ(hits_at({0.0, 0.4, 0.8}), 1);
  EXPECT_EQ(hits_at({0.0, 3.0, 6.0}), 1);
  EXPECT_EQ(hits_at({5.0, 5.0, 5.0}), 1) << "it stood";
  EXPECT_EQ(hits_at({0.0, 0.1, 0.2, 9.0}), 3) << "one leap does not count";
  EXPECT_EQ(hits_at({0.0, 0.1, 0.5}), 1) << "the upper one of two in the middle";
}

TEST(ScanMapper, ARoomHasItsWallsWhereTheyStandAndAClearFloor) {
  Rng rng{5};
  std::vector<PlacedSweep> sweeps;
  for (int i = 0; i < 20; ++i)
    sweeps.push_back(in_room({rng.uniform(-3, 3), rng.uniform(-2, 2), Angle::radians(rng.uniform(-3.1, 3.1))}, 360));
  const OccupancyGrid map = map_of(sweeps);
  EXPECT_NEAR(map.frame.columns * map.frame.resolution, 10.0, 0.2);  // the room and its border
  std::size_t free = 0;
  std::size_t occupied = 0;
  for (int row = 0; row < map.frame.rows; ++row) {
    for (int column = 0; column < map.frame.columns; ++column) {
      const Point2 centre = map.frame.centre({column, row});
      const double outside = std::max(std::abs(centre.x) - kEast, std::abs(centre.y) - kNorth);
      const bool is_occupied = map.is_occupied({column, row});
      free += map.is_free({column, row}) ? 1 : 0;
      occupied += is_occupied ? 1 : 0;
      if (is_occupied) {
        EXPECT_LT(std::abs(outside), 0.05) << centre.x << ", " << centre.y;
      }
      if (outside > 0.05) {
        EXPECT_EQ(map.at({column, row}), OccupancyGrid::kUnknown) << centre.x << ", " << centre.y;
      }
      if (outside < -0.15) {
        EXPECT_TRUE(map.is_free({column, row})) << centre.x << ", " << centre.y;
      }
    }
  }
  EXPECT_NEAR(static_cast<double>(free), 8.0 * 6.0 / 0.0025, 800.0);
  EXPECT_GT(occupied, 500U);  // of 560 cells along the walls
}

TEST(ScanMapper, WhoWalkedThroughLeavesNoTrace) {
  std::vector<PlacedSweep> sweeps;
  for (int i = 0; i < 8; ++i) sweeps.push_back(in_room({-2.0, 0.02, Angle{}}, 360));
  // Somebody at 1 m before the sensor, in two of the sweeps.
  for (std::size_t sweep : {2U, 3U})
    for (sensor_models::SweepBeam& beam : sweeps[sweep].sweep.beams)
      if (std::abs(beam.bearing) < 10.0 * kDegree) beam.range = 1.02;
  EXPECT_TRUE(map_of({sweeps[2]}).is_occupied(map_of({sweeps[2]}).frame.cell_at({-0.98, 0.02})));
  EXPECT_EQ(at(map_of(sweeps), {-0.98, 0.02}), OccupancyGrid::kFree);
  EXPECT_EQ(at(map_of(sweeps), {kEast, 0.02}), OccupancyGrid::kOccupied);
}

TEST(ScanMapper, EvidenceIsTheSumOfLogOddsAndOneASweep) {
  ScanMapperParams params;
  params.most_log_odds = 2.0;
  const std::vector<PlacedSweep> sweeps{in_room({0, 0, Angle{}}, 3600)};  // many beams a cell
  ScanMapper mapper{ScanMapper::frame_of(sweeps, params).value(), params};
  const GridFrame frame = ScanMapper::frame_of(sweeps, params).value();
  const auto log_odds = [&](Point2 point) {
    return static_cast<double>(mapper.log_odds()[frame.index(frame.cell_at(point))]);
  };
  mapper.add(sweeps[0]);
  EXPECT_NEAR(log_odds({1.0, 1.0}), std::log(0.35 / 0.65), 1e-6);
  EXPECT_NEAR(log_odds({kEast, 1.0}), std::log(0.7 / 0.3), 1e-6);
  mapper.add(sweeps[0]);
  EXPECT_NEAR(log_odds({1.0, 1.0}), 2.0 * std::log(0.35 / 0.65), 1e-6);
  for (int i = 0; i < 10; ++i) mapper.add(sweeps[0]);
  EXPECT_NEAR(log_odds({1.0, 1.0}), -2.0, 1e-6);
}

TEST(ScanMapper, AWallSurvivesScansThatGrazeIt) {
  // A corridor of 40 x 2.4 m, seen from every second metre of it at poses that are some centimetres off.
  Rng rng{8};
  std::vector<PlacedSweep> sweeps;
  for (double x = -18.0; x <= 18.0; x += 2.0) {
    const Pose2 truth{x, rng.uniform(-0.4, 0.4), Angle::radians(rng.uniform(-0.3, 0.3))};
    PlacedSweep placed{
        {}, {truth.x, truth.y + rng.normal(0.0, 0.03), truth.theta + Angle::radians(rng.normal(0.0, 0.005))}};
    for (int degree = -90; degree <= 90; ++degree) {
      const Point2 along = unit(truth.theta + Angle::degrees(degree));
      const double to_side = ((along.y > 0 ? 1.22 : -1.22) - truth.y) / along.y;
      const double to_end = ((along.x > 0 ? 20.02 : -20.02) - truth.x) / along.x;
      placed.sweep.beams.push_back({degree * kDegree, std::min(to_side, to_end), false});
    }
    sweeps.push_back(placed);
  }
  const auto gaps_of = [&](double margin) {
    ScanMapperParams params;
    params.margin = margin;
    const OccupancyGrid map = map_of(sweeps, params);
    int gaps = 0;
    for (double x = -15.0; x < 15.0; x += 0.05)
      for (const double wall : {-1.22, 1.22}) {
        bool is_there = false;
        for (double off = -0.15; off <= 0.15; off += 0.05)
          is_there |= at(map, {x, wall + off}) == OccupancyGrid::kOccupied;
        gaps += is_there ? 0 : 1;
      }
    return gaps;
  };
  const int gaps = gaps_of(ScanMapperParams{}.margin);
  EXPECT_LT(gaps, 60);  // of 1200 places along the walls
  EXPECT_GT(gaps_of(0.0), 4 * gaps);
}

TEST(ScanMapper, TheFloorBetweenNeighboursIsClearAndBehindThemUnknown) {
  PlacedSweep placed;
  for (int i = -20; i <= 20; ++i) placed.sweep.beams.push_back({i * kDegree, 10.0 / std::cos(i * kDegree), false});
  const OccupancyGrid map = map_of({placed});
  const Point2 between = 9.0 * unit(Angle::degrees(0.5));  // 8 cm from either beam
  EXPECT_EQ(at(map, between), OccupancyGrid::kFree);
  EXPECT_EQ(at(map, {10.5, 0.0}), OccupancyGrid::kUnknown);
  ScanMapperParams rays;
  rays.widest_gap = 0.0;
  EXPECT_EQ(at(map_of({placed}, rays), between), OccupancyGrid::kUnknown);
}

TEST(ScanMapper, AWallSeenFromAfarHasNoGapsAndADoorStaysOpen) {
  PlacedSweep placed;  // a wall at 12 m, beams 21 cm apart, and a door of 1.2 m in it
  for (int i = -20; i <= 20; ++i) {
    const double range = 12.02 / std::cos(i * kDegree);
    const bool is_door = std::abs(range * std::sin(i * kDegree) - 1.5) < 0.6;
    placed.sweep.beams.push_back({i * kDegree, is_door ? 18.0 : range, false});
  }
  const OccupancyGrid map = map_of({placed});
  for (double y = -4.0; y < 4.0; y += 0.05) {
    if (std::abs(std::abs(y - 1.5) - 0.6) < 0.25) continue;  // at the door's posts
    EXPECT_EQ(at(map, {12.02, y}) == OccupancyGrid::kOccupied, std::abs(y - 1.5) > 0.6) << y;
  }
}

TEST(ScanMapper, ABeamWithoutReturnSaysNothingAndAFarOneOnlyClears) {
  PlacedSweep placed;
  placed.sweep.beams = {{0.0, 80.0, true}, {0.5 * std::numbers::pi, 30.0, false}, {std::numbers::pi, 5.0, false}};
  ScanMapperParams params;
  params.reach = 20.0;
  params.border = 40.0;
  const OccupancyGrid map = map_of({placed}, params);
  EXPECT_EQ(at(map, {1.0, 0.01}), OccupancyGrid::kUnknown);
  EXPECT_EQ(at(map, {0.0, 19.0}), OccupancyGrid::kFree);
  EXPECT_EQ(at(map, {0.0, 21.0}), OccupancyGrid::kUnknown);
  EXPECT_EQ(at(map, {0.0, 30.0}), OccupancyGrid::kUnknown);
  EXPECT_TRUE(
      map.is_occupied(map.frame.cell_at(placed.map_from_sensor * sensor_models::endpoint(placed.sweep.beams[2]))));
}

TEST(ScanMapper, RefusesWhatCannotBeMapped) {
  EXPECT_FALSE(ScanMapper::frame_of({}, {}));
  std::vector<PlacedSweep> far(2);
  far[1].map_from_sensor.x = 1e9;
  far[1].map_from_sensor.y = 1e9;
  EXPECT_FALSE(ScanMapper::frame_of(far, {}));
  ScanMapperParams params;
  params.pass = 0.5;
  EXPECT_FALSE(params.validate());
  params = {};
  params.free = 0.7;
  EXPECT_FALSE(params.validate());
  EXPECT_TRUE(ScanMapperParams{}.validate());
}

TEST(ScanMapper, WhatTooFewSweepsMetIsUnknown) {
  std::vector<PlacedSweep> sweeps(3, in_room({}, 360));
  ScanMapperParams params;
  params.fewest_hits = 3;
  EXPECT_EQ(at(map_of(sweeps, params), {kEast, 0.5}), OccupancyGrid::kOccupied);
  sweeps.pop_back();
  EXPECT_EQ(at(map_of(sweeps, params), {kEast, 0.5}), OccupancyGrid::kUnknown);
  EXPECT_EQ(at(map_of(sweeps), {kEast, 0.5}), OccupancyGrid::kOccupied);
  params.fewest_hits = 0;
  EXPECT_FALSE(params.validate());
}

TEST(ScanMapper, ABeamThatPassesIsNoHit) {
  std::vector<PlacedSweep> sweeps(2, in_room({}, 360));
  PlacedSweep through;
  through.sweep.beams.push_back({std::atan2(0.5, kEast), 6.0, false});
  sweeps.push_back(through);
  ScanMapperParams params;
  params.fewest_hits = 2;
  EXPECT_EQ(at(map_of(sweeps, params), {kEast, 0.5}), OccupancyGrid::kOccupied) << "two against one";
  params.fewest_hits = 3;
  EXPECT_EQ(at(map_of(sweeps, params), {kEast, 0.5}), OccupancyGrid::kUnknown);
}

TEST(ScanMapper, ABeamWithoutAReturnShowsFloorOnlyAsFarAsIsSaid) {
  PlacedSweep lost{{}, {0.01, 0.01, {}}};
  for (int i = 0; i < 90; ++i) lost.sweep.beams.push_back({kDegree * i, 10.0, true});
  lost.sweep.beams.push_back({-3.0, 3.0, false});  // so that there is something to map
  ScanMapperParams params;
  params.border = 8.0;
  EXPECT_EQ(at(map_of({lost}, params), {1.4, 1.4}), OccupancyGrid::kUnknown);
  params.empty_reach = 4.0;
  const OccupancyGrid map = map_of({lost}, params);
  EXPECT_EQ(at(map, {1.4, 1.4}), OccupancyGrid::kFree);
  EXPECT_EQ(at(map, {3.4, 3.4}), OccupancyGrid::kUnknown);
  for (sensor_models::SweepBeam& beam : lost.sweep.beams)
    if (beam.no_return) beam.range = 1.5;
  EXPECT_EQ(at(map_of({lost}, params), {1.4, 1.4}), OccupancyGrid::kUnknown) << "nor farther than it looks";
}

TEST(ScanMapper, TheBodyShowsThatTheFloorIsFree) {
  const std::vector<PlacedSweep> sweeps{in_room({}, 4)};
  ScanMapper mapper{ScanMapper::frame_of(sweeps, {}).value(), {}};
  EXPECT_EQ(at(mapper.map(), {1.2, 1.1}), OccupancyGrid::kUnknown);
  mapper.stand({1.0, 1.0}, 0.3);
  EXPECT_EQ(at(mapper.map(), {1.2, 1.1}), OccupancyGrid::kFree);
  EXPECT_EQ(at(mapper.map(), {1.4, 1.4}), OccupancyGrid::kUnknown);
}

TEST(ScanMapper, WhoStandsDuringOnePieceOfTheWayIsNoWall) {
  PlacedSweep with_somebody = in_room({}, 720);
  for (auto& beam : with_somebody.sweep.beams)
    if (std::abs(beam.bearing - 1.0) < 0.1) beam.range = 1.5;
  const Point2 somebody = 1.5 * unit(Angle::radians(1.0));
  const std::vector<PlacedSweep> frame_of{in_room({}, 720)};
  for (const bool comes_last : {false, true}) {
    ScanMapper mapper{ScanMapper::frame_of(frame_of, {}).value(), {}};
    const auto piece = [&](bool is_there, int sweeps) {
      for (int i = 0; i < sweeps; ++i) mapper.add(is_there ? with_somebody : frame_of.front());
    };
    piece(!comes_last, comes_last ? 10 : 30);
    mapper.end_piece();
    piece(comes_last, comes_last ? 30 : 10);
    mapper.end_piece();
    EXPECT_EQ(at(mapper.map(), somebody), OccupancyGrid::kFree) << comes_last;
    EXPECT_EQ(at(mapper.map(), {kEast, 0.0}), OccupancyGrid::kOccupied) << "the wall";
  }
}

}  // namespace
}  // namespace docent::mapping::scan_mapper_test
