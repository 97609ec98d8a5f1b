#include "docent/apps/laboratory/take_pictures/picture_drive.h"

#include <gtest/gtest.h>

#include <cmath>

#include "docent/apps/laboratory/take_pictures/drawn_hall.h"

namespace docent::apps::take_pictures_command {
namespace {

TEST(PictureDrive, GoesEverywhereAndKeepsOffWhatStandsThere) {
  const simulator::World world = drawn_hall({.length = 20.0, .width = 14.0, .seed = 4});
  DriveOptions options;
  options.pictures = 500;
  const auto drive = drive_everywhere(world, options, Rng{1});
  ASSERT_TRUE(drive) << drive.error().message;
  EXPECT_EQ(drive->pictures.size(), 500U);
  for (const Moment& moment : drive->moments)
    for (const simulator::Solid& solid : world.solids)
      ASSERT_GT(distance(solid.polygon, moment.world_from_base.position()), 0.2) << solid.id;
  int seen = 0, all = 0;
  for (double x = 1.0; x < 20.0; x += 1.0)
    for (double y = 1.0; y < 14.0; y += 1.0) {
      ++all;
      for (const std::size_t i : drive->pictures)
        if (distance(drive->moments[i].world_from_base.position(), Point2{x, y}) < 2.0) {
          ++seen;
          break;
        }
    }
  EXPECT_GT(seen, 0.97 * all);
}

TEST(PictureDrive, FollowsAWayAtItsSpeed) {
  DriveOptions options;
  options.spacing = 0.5;
  const auto drive = drive_along({{0.0, 0.0}, {6.0, 0.0}, {6.0, 4.0}}, options);
  ASSERT_TRUE(drive);
  EXPECT_NEAR(static_cast<double>(drive->pictures.size()), 20.0, 5.0);
  EXPECT_LT(distance(drive->moments.back().world_from_base.position(), Point2{6.0, 4.0}), 0.5);
  for (std::size_t i = 1; i < drive->moments.size(); ++i)
    ASSERT_LE(distance(drive->moments[i].world_from_base.position(), drive->moments[i - 1].world_from_base.position()),
              0.5 * kTick + 1e-9);
  const Pose2 between = drive->at(0.5 * kTick);
  EXPECT_NEAR(between.x, 0.5 * drive->moments[1].world_from_base.x, 1e-9);
  EXPECT_FALSE(drive_along({{0.0, 0.0}}, options));
}

TEST(PictureDrive, OdometryDriftsAndTheMapsPosesDoNot) {
  const simulator::World world = drawn_hall({});
  const auto drive = drive_everywhere(world, {}, Rng{2});
  ASSERT_TRUE(drive);
  double map = 0.0, odometry = 0.0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const ToldPoses told = told_poses(*drive, Rng{seed});
    const Pose2 world_from_start = drive->moments[drive->pictures.front()].world_from_base;
    const Pose2 last = drive->moments[drive->pictures.back()].world_from_base;
    odometry += distance((world_from_start * told.odometry.back()).position(), last.position()) / 10.0;
    double square = 0.0;
    for (std::size_t i = 0; i < told.map.size(); ++i)
      square +=
          std::pow(distance(told.map[i].position(), drive->moments[drive->pictures[i]].world_from_base.position()), 2);
    map += std::sqrt(square / static_cast<double>(told.map.size())) / 10.0;
  }
  EXPECT_GT(odometry, 0.5);
  EXPECT_NEAR(map, 0.045, 0.02);
}

}  // namespace
}  // namespace docent::apps::take_pictures_command
