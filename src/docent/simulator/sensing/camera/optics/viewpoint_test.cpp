#include "docent/simulator/sensing/camera/optics/viewpoint.h"

#include <gtest/gtest.h>

#include <numbers>

namespace docent::simulator {
namespace {

void expect_near(Vec3 a, Vec3 b) {
  EXPECT_NEAR(a.x, b.x, 1e-5F);
  EXPECT_NEAR(a.y, b.y, 1e-5F);
  EXPECT_NEAR(a.z, b.z, 1e-5F);
}

constexpr double kQuarter = std::numbers::pi / 2.0;

TEST(Viewpoint, LooksWhereItIsTurned) {
  const Viewpoint left = viewpoint_at({1.0F, 2.0F, 3.0F}, kQuarter, 0.0);
  expect_near(left.ahead, {0.0F, 1.0F, 0.0F});
  expect_near(left.right, {1.0F, 0.0F, 0.0F});
  expect_near(left.down, {0.0F, 0.0F, -1.0F});
  expect_near(left.to_camera({1.0F, 5.0F, 2.0F}), {0.0F, 1.0F, 3.0F});
  const Viewpoint up = viewpoint_at({}, 0.0, kQuarter);
  expect_near(up.ahead, {0.0F, 0.0F, 1.0F});
  expect_near(up.down, {1.0F, 0.0F, 0.0F});
  expect_near(up.right, {0.0F, -1.0F, 0.0F});
}

TEST(Viewpoint, SitsOnTheRobotAndLeansWithIt) {
  const CameraMount mount{.x = 0.1, .y = 0.0, .z = 1.2, .pan = 0.0, .tilt = kQuarter, .roll = 0.0};
  const Viewpoint level = viewpoint_of(mount, {5.0, 6.0, Angle::degrees(90.0)});
  expect_near(level.eye, {5.0F, 6.1F, 1.2F});
  expect_near(level.ahead, {0.0F, 0.0F, 1.0F});
  expect_near(level.down, {0.0F, 1.0F, 0.0F});
  const Viewpoint leaning = viewpoint_of(mount, {0.0, 0.0, Angle{}}, {.roll = 0.0, .pitch = 0.1});
  EXPECT_GT(leaning.ahead.x, 0.09F) << "forwards";
  EXPECT_GT(leaning.eye.x, 0.2F) << "the camera goes with it";
  EXPECT_LT(viewpoint_of(mount, {}, {.roll = 0.1, .pitch = 0.0}).ahead.y, -0.09F) << "to the right";
}

TEST(Viewpoint, RollsClockwise) {
  const CameraMount mount{.x = 0.0, .y = 0.0, .z = 1.0, .pan = 0.0, .tilt = 0.0, .roll = 0.2};
  const Viewpoint rolled = viewpoint_of(mount, {});
  EXPECT_LT(rolled.right.z, -0.19F) << "its right side sinks";
  EXPECT_LT(rolled.down.y, 0.25F);
  EXPECT_GT(rolled.down.y, 0.19F) << "and its foot goes to the left";
}

}  // namespace
}  // namespace docent::simulator
