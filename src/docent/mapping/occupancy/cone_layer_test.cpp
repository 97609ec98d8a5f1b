#include "docent/mapping/occupancy/cone_layer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "docent/geometry/polygon.h"

namespace docent::mapping::cone_layer_test {
namespace {

constexpr double kCell = 0.15;  // [m]
constexpr GridFrame kFrame{40, 40, kCell, {0.0, 0.0}};
constexpr double kCone = 0.26;      // [rad]
constexpr Point2 kStool{4.0, 3.0};  // its middle
constexpr double kRadius = 0.3;     // [m] of the stool

/// A ring of sonars round a robot, a stool that only they see, and the layer that they fill.
class ConeLayerTest : public ::testing::Test {
 protected:
  /// All sonars once, as a true cone would answer: the nearest point of the stool in it.
  void hear(const Pose2& map_from_base, std::span<const LaserLook> lasers) {
    constexpr int kSonars = 24;
    for (int i = 0; i < kSonars; ++i) {
      const Angle bearing = Angle::degrees(360.0 * i / kSonars);
      const Point2 place = 0.25 * unit(bearing);
      const Pose2 map_from_sensor = map_from_base * Pose2{place.x, place.y, bearing};
      double range = 5.0;
      for (int ray = -8; ray <= 8; ++ray) {
        const Point2 along = unit(map_from_sensor.theta + Angle::radians(0.5 * kCone * ray / 8.0));
        const auto hit =
            stool ? ray_distance(map_from_sensor.position(), along, kStool, kRadius) : std::optional<double>{};
        range = std::min(range, hit.value_or(range));
      }
      layer.add({map_from_sensor, kCone, 5.0, range}, lasers, time_from_seconds(now));
    }
    now += 0.4;
  }
  /// The lasers look all round, over the stool.
  void hear(const Pose2& map_from_base, int times = 1) {
    const LaserLook all_round{map_from_base, -3.2, 6.4, {}};
    for (int i = 0; i < times; ++i) hear(map_from_base, {&all_round, 1});
  }
  [[nodiscard]] bool blocked(Point2 point) const { return layer.is_blocked(kFrame.index(kFrame.cell_at(point))); }
  [[nodiscard]] int blocked_cells() const {
    int count = 0;
    for (std::size_t i = 0; i < kFrame.size(); ++i) count += layer.is_blocked(i) ? 1 : 0;
    return count;
  }

  bool stool = true;
  double now = 1.0;  ///< [s]
  ConeLayer layer{kFrame, std::vector<bool>(kFrame.size(), false), {}};
};

TEST_F(ConeLayerTest, IsThereWithinFiveSecondsAndGoneSoonAfterItIsSeenGone) {
  const Pose2 here{3.0, 3.0, {}};
  while (!blocked({3.7, 3.05}) && now < 10.0) hear(here);
  EXPECT_LT(now, 5.0 + 1.0);
  EXPECT_TRUE(layer.is_thing(kFrame.index(kFrame.cell_at({3.7, 3.05}))));
  EXPECT_TRUE(layer.take_changes().has_value());
  EXPECT_FALSE(layer.take_changes().has_value());
  hear(here, 30);
  stool = false;
  const double gone = now;
  while (blocked_cells() > 0 && now < gone + 60.0) hear(here);
  EXPECT_LT(now - gone, 30.0);
  EXPECT_TRUE(layer.take_changes().has_value());
}

TEST_F(ConeLayerTest, SeveralPlacesLeaveOfEachArcWhatAllAllow) {
  hear({2.5, 3.0, {}}, 8);
  // An arc at 1 m is wider than what answers there: beside the stool too cells are blocked ...
  int before = 0;
  int after = 0;
  const auto count_off = [&] {
    int off = 0;
    for (int row = 0; row < kFrame.rows; ++row) {
      for (int column = 0; column < kFrame.columns; ++column) {
        const bool is_off = distance(kFrame.centre({column, row}), kStool) > kRadius + kCell;
        off += is_off && layer.is_blocked(kFrame.index({column, row})) ? 1 : 0;
      }
    }
    return off;
  };
  before = count_off();
  // ... until the robot has looked along both sides.
  for (double x = 2.6; x < 5.5; x += 0.1) {
    hear({x, 3.8, {}});
    hear({x, 2.2, {}});
  }
  after = count_off();
  EXPECT_LE(after, before);
  EXPECT_EQ(after, 0);
  for (const Point2 side : {Point2{4.0, 3.3}, Point2{4.0, 2.7}}) EXPECT_TRUE(blocked(side)) << side.x << " " << side.y;
}

TEST_F(ConeLayerTest, WhatALaserMeetsStandsInTheLasersLayer) {
  const Pose2 here{3.0, 3.0, {}};
  std::vector<Point2> person;
  for (int i = 0; i < 36; ++i) person.push_back(kStool + kRadius * unit(Angle::degrees(10.0 * i)));
  const LaserLook laser{here, -3.2, 6.4, person};
  for (int i = 0; i < 20; ++i) hear(here, {&laser, 1});
  EXPECT_EQ(blocked_cells(), 0);
}

TEST_F(ConeLayerTest, WhereNoLaserLooksItMayBeSomebody) {
  const Pose2 here{3.0, 3.0, {}};
  const LaserLook backwards{{3.0, 3.0, Angle::degrees(180)}, -1.0, 2.0, {}};
  for (int i = 0; i < 20; ++i) hear(here, {&backwards, 1});
  const std::size_t front = kFrame.index(kFrame.cell_at({3.7, 3.05}));
  EXPECT_TRUE(layer.is_blocked(front));
  EXPECT_FALSE(layer.is_thing(front));
  layer.forget(time_from_seconds(now + 31.0));
  EXPECT_EQ(blocked_cells(), 0);
}

TEST_F(ConeLayerTest, AThingIsRememberedForMinutesWhileNobodyLooks) {
  hear({3.0, 3.0, {}}, 20);
  layer.forget(time_from_seconds(now + 250.0));
  EXPECT_TRUE(blocked({3.7, 3.05}));
  layer.forget(time_from_seconds(now + 301.0));
  EXPECT_EQ(blocked_cells(), 0);
}

TEST_F(ConeLayerTest, AMappedWallIsNoNews) {
  std::vector<bool> known(kFrame.size(), false);
  for (int row = 0; row < kFrame.rows; ++row)
    for (int column = kFrame.cell_at(kStool).column - 3; column < kFrame.columns; ++column)
      known[kFrame.index({column, row})] = true;
  layer = ConeLayer{kFrame, known, {}};
  hear({3.0, 3.0, {}}, 20);
  EXPECT_EQ(blocked_cells(), 0);
}

TEST_F(ConeLayerTest, NoReadingSaysNothing) {
  hear({3.0, 3.0, {}}, 20);
  const int before = blocked_cells();
  for (int i = 0; i < 20; ++i)
    layer.add({{3.0, 3.0, {}}, kCone, 5.0, std::numeric_limits<double>::quiet_NaN()}, {}, time_from_seconds(now));
  EXPECT_EQ(blocked_cells(), before);
}

TEST(ConeLayerParams, AreChecked) {
  EXPECT_TRUE(ConeLayerParams{}.validate());
  EXPECT_FALSE((ConeLayerParams{.reach = 0.0}.validate()));
  EXPECT_FALSE((ConeLayerParams{.block = 4.0}.validate()));
}

}  // namespace
}  // namespace docent::mapping::cone_layer_test
