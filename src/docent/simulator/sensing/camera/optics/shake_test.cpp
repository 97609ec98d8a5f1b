#include "docent/simulator/sensing/camera/optics/shake.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace docent::simulator {
namespace {

TEST(Shake, RocksAboutBothAxesWithinItsBound) {
  const double most = 0.3 * std::numbers::pi / 180.0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const Shake shake{most, seed};
    double roll = 0.0, pitch = 0.0, sum = 0.0;
    for (int i = 0; i < 6000; ++i) {
      const Lean lean = shake.at(0.01 * i);
      roll = std::max(roll, std::abs(lean.roll));
      pitch = std::max(pitch, std::abs(lean.pitch));
      sum += lean.pitch;
    }
    EXPECT_LE(std::max(roll, pitch), most);
    EXPECT_GT(std::min(roll, pitch), 0.7 * most) << seed;
    EXPECT_LT(std::abs(sum / 6000.0), 0.05 * most) << "about the upright";
  }
}

TEST(Shake, IsAnotherWithAnotherSeed) { EXPECT_NE(Shake(0.01, 1).at(1.0).roll, Shake(0.01, 2).at(1.0).roll); }

}  // namespace
}  // namespace docent::simulator
