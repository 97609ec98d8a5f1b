#include "docent/mapping/occupancy/growing_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace docent::mapping::growing_map_test {
namespace {

/// A round wall of 3 m about the sensor.
std::vector<MountedSweep> round_wall() {
  MountedSweep mounted;
  for (int i = 0; i < 360; ++i) mounted.sweep.beams.push_back({std::numbers::pi * (i - 180) / 180.0, 3.02, false});
  return {mounted};
}

std::int8_t at(const OccupancyGrid& map, Point2 point) { return map.at(map.frame.cell_at(point)); }

TEST(GrowingMap, GrowsWithTheWay) {
  GrowingMap growing{{}, 0.3};
  EXPECT_TRUE(growing.work(10));
  EXPECT_TRUE(growing.map().cells.empty());
  std::vector<Pose2> poses;
  for (int i = 0; i < 12; ++i) {
    poses.push_back({2.0 * i, 0.0, {}});
    growing.add(round_wall(), poses.back());
    while (!growing.work(3)) {
    }
    const OccupancyGrid map = growing.map();
    EXPECT_EQ(at(map, poses.back().position()), OccupancyGrid::kFree) << i;
    EXPECT_EQ(at(map, {2.0 * i + 3.02, 0.01}), OccupancyGrid::kOccupied) << i;
  }
  EXPECT_EQ(growing.moments(), 12U);
  EXPECT_EQ(growing.placed(poses).size(), 12U);
}

TEST(GrowingMap, IsDrawnAnewWhereEarlierPosesMoved) {
  GrowingMap growing{{}, 0.3};
  growing.add(round_wall(), {});
  growing.add(round_wall(), {});
  EXPECT_EQ(at(growing.map(), {0.01, 3.02}), OccupancyGrid::kOccupied);
  const std::vector<Pose2> moved{{0.0, 1.0, {}}, {0.0, 1.0, {}}};
  growing.move(moved);
  EXPECT_FALSE(growing.work(1)) << "one of two is drawn";
  EXPECT_EQ(at(growing.map(), {0.01, 3.02}), OccupancyGrid::kOccupied) << "the old one is in use meanwhile";
  EXPECT_TRUE(growing.work(1));
  EXPECT_EQ(at(growing.map(), {0.01, 3.02}), OccupancyGrid::kFree);
  EXPECT_EQ(at(growing.map(), {0.01, 4.02}), OccupancyGrid::kOccupied);
}

TEST(GrowingMap, IsNotDrawnAnewForACentimetre) {
  GrowingMap growing{{}, 0.3};
  growing.add(round_wall(), {});
  growing.move(std::vector<Pose2>{{0.01, 0.0, {}}});
  EXPECT_TRUE(growing.work(0));
}

}  // namespace
}  // namespace docent::mapping::growing_map_test
