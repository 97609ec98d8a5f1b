#include "docent/simulator/sensing/camera/mount.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace docent::simulator {
namespace {

TEST(Mount, TurnsTheShorterWayAsFastAsItCanAndStops) {
  Mount mount;
  mount.command({3.0, -0.3, 1.0});
  for (int i = 0; i < 400; ++i) mount.step(0.01);
  EXPECT_NEAR(mount.view().pan, 3.0, 1e-9);
  mount.command({-3.0, -0.3, 1.0});
  mount.step(0.1);
  EXPECT_NEAR(mount.view().pan, 3.0 + 1.4 * 0.1, 1e-9) << "over the back, not all round";
  for (int i = 0; i < 100; ++i) mount.step(0.01);
  EXPECT_NEAR(std::remainder(mount.view().pan + 3.0, 2.0 * std::numbers::pi), 0.0, 1e-9);
}

TEST(Mount, StaysWithinItsEnds) {
  Mount mount;
  mount.command({0.0, -9.0, 9.0});
  for (int i = 0; i < 1000; ++i) mount.step(0.01);
  EXPECT_NEAR(mount.view().tilt, MountParams{}.lowest, 1e-9);
  EXPECT_NEAR(mount.view().field_of_view, MountParams{}.widest, 1e-9);
}

}  // namespace
}  // namespace docent::simulator
