#include "docent/localization/sonar/tracker/echo_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "docent/base/random.h"
#include "docent/localization/sonar/tracker/testing.h"

namespace docent::localization::echo_map_test {
namespace {

constexpr double kCone = 10.0 * std::numbers::pi / 180.0;

TEST(EchoMap, KnowsHowABuildingIsTurned) {
  for (const double turn : {0.0, 7.0, -23.0, 40.0, 44.5, 31.3}) {
    const EchoMap map{testing::TurnedRoom{turn}.map};
    const auto main = map.main_direction();
    ASSERT_TRUE(main);
    EXPECT_NEAR(std::remainder(main->heading.degrees() - turn, 90.0), 0.0, 1.0)
        << turn << ": a small room; buildings are surer";
    EXPECT_GT(main->share, 0.6) << turn;
  }
}

TEST(EchoMap, ARoundHallHasNoMainDirectionAndAnEmptyMapNone) {
  OccupancyGrid map;
  map.frame = {200, 200, 0.05, {-5.0, -5.0}};
  map.cells.assign(map.frame.size(), OccupancyGrid::kFree);
  EXPECT_FALSE(EchoMap{map}.main_direction());
  for (int row = 0; row < 200; ++row)
    for (int column = 0; column < 200; ++column)
      if (norm(map.frame.centre({column, row})) > 4.5) map.cells[map.frame.index({column, row})] = 100;
  EXPECT_LT(EchoMap{map}.main_direction()->share, 0.35);
}

TEST(EchoMap, ExpectsWhatAConeWouldHear) {
  const testing::TurnedRoom room{17.0};
  const EchoMap map{room.map};
  Rng rng{4};
  int near = 0;
  double sum = 0.0;
  for (int i = 0; i < 400; ++i) {
    const Pose2 pose = room.map_from_room *
                       Pose2{rng.uniform(-3.5, 0.7), rng.uniform(-1.5, 2.0), Angle::radians(rng.uniform(-3.1, 3.1))};
    double exact = 1e9;
    for (int k = -20; k <= 20; ++k) {
      const Point2 sound = unit(pose.theta + Angle::radians(kCone * k / 20.0));
      for (const Segment& wall : room.walls) {
        if (const auto hit = ray_distance(pose.position(), sound, wall)) exact = std::min(exact, *hit);
      }
    }
    const auto expected = map.expect(pose, kCone, 9, 12.0);
    ASSERT_TRUE(expected);
    // A raster blurs corners at the cone's edge, and walls that are met at a grazing angle.
    if (std::abs(expected->range - exact) < 0.08) ++near;
    sum += std::clamp(expected->range - exact, -0.2, 0.2);
  }
  EXPECT_GT(near, 375);
  EXPECT_NEAR(sum / 400.0, 0.0, 0.02);
}

TEST(EchoMap, WallsAreNotBiased) {
  double sum = 0.0;
  int count = 0;
  for (const double turn : {0.0, 11.0, 29.0, 45.0}) {
    const testing::TurnedRoom room{turn};
    const EchoMap map{room.map};
    for (double x = -3.0; x < 0.5; x += 0.07) {
      const Pose2 pose = room.map_from_room * Pose2{x, 0.5, Angle::degrees(90.0)};
      sum += map.expect(pose, kCone, 9, 5.0)->range - 2.0;
      ++count;
    }
  }
  EXPECT_NEAR(sum / count, 0.0, 0.015);
}

TEST(EchoMap, SaysHowSlantedASurfaceIsAndWhenThereIsNone) {
  const testing::TurnedRoom room{0.0};
  const EchoMap map{room.map};
  const Point2 place = (room.map_from_room * Pose2{-1.0, 0.5, Angle{}}).position();
  EXPECT_NEAR(map.expect({place.x, place.y, Angle::degrees(90.0)}, 0.01, 1, 5.0)->slant, 0.0, 0.1);
  EXPECT_NEAR(map.expect({place.x, place.y, Angle::degrees(60.0)}, 0.01, 1, 5.0)->slant, 0.52, 0.1);
  EXPECT_FALSE(map.expect({place.x, place.y, Angle::degrees(90.0)}, kCone, 5, 1.0)) << "beyond its range";
  EXPECT_FALSE(map.expect({room.walls[0].a.x, room.walls[0].a.y, Angle{}}, kCone, 5, 5.0)) << "inside a wall";
}

}  // namespace
}  // namespace docent::localization::echo_map_test
