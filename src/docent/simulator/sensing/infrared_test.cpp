#include "docent/simulator/sensing/infrared.h"

#include <gtest/gtest.h>

#include <cmath>

namespace docent::simulator {
namespace {

RayCaster wall_at(double x, bool glass = false) {
  const std::vector<Surface> wall{Surface{Segment{{x, -3.0}, {x, 3.0}}, glass, 0.3}};
  return RayCaster{wall};
}

TEST(InfraredRing, ReadsAWallWithNoiseThatGrowsWithTheDistance) {
  const auto spread = [](double distance) {
    const auto walls = wall_at(0.25 + distance);
    InfraredRing ring{{}, Rng{3}};
    double sum = 0.0;
    double squares = 0.0;
    constexpr int kReadings = 2000;
    int used = 0;
    for (int i = 0; i < kReadings; ++i) {
      const double range = ring.read(0, walls, {}, {});
      if (range > 0.79 || std::abs(range - distance) > 0.3) continue;  // glare, flicker
      sum += range;
      squares += range * range;
      ++used;
    }
    EXPECT_GT(used, 0.95 * kReadings);
    const double mean = sum / used;
    EXPECT_NEAR(mean, distance, 0.05 * distance + 0.005);  // calibration
    return std::sqrt(squares / used - mean * mean);
  };
  const double near = spread(0.15);
  const double far = spread(0.55);
  EXPECT_LT(near, 0.01);
  EXPECT_GT(far, 2.0 * near);
}

TEST(InfraredRing, NothingWithinReachReadsTheLargest) {
  InfraredRing ring{{}, Rng{4}};
  const auto walls = wall_at(2.0);
  int most = 0;
  for (int i = 0; i < 500; ++i) most += ring.read(0, walls, {}, {}) == 0.8 ? 1 : 0;
  EXPECT_GT(most, 490);
}

TEST(InfraredRing, HasFailuresOfItsOwn) {
  InfraredRing ring{{}, Rng{5}};
  const auto nothing = wall_at(9.0);
  const std::vector<Disc> far{{{0.25 + 0.6 + 0.25, 0.0}, 0.25}};
  const std::vector<Disc> near{{{0.25 + 0.2 + 0.25, 0.0}, 0.25}};
  int missed_far = 0;
  int missed_near = 0;
  for (int i = 0; i < 1000; ++i) {
    missed_far += ring.read(0, nothing, far, {}) > 0.79 ? 1 : 0;
    missed_near += ring.read(0, nothing, near, {}) > 0.79 ? 1 : 0;
  }
  EXPECT_GT(missed_far, 200);  // dark clothes
  EXPECT_LT(missed_near, 20);
  // Glass is looked through, and what touches the sensor reads too far.
  EXPECT_EQ(ring.read(0, wall_at(0.6, true), {}, {}), 0.8);
  double folded = 0.0;
  const auto touching = wall_at(0.26);
  for (int i = 0; i < 100; ++i) folded += 0.01 * ring.read(0, touching, {}, {});
  EXPECT_NEAR(folded, 0.11, 0.02);
}

}  // namespace
}  // namespace docent::simulator
