#include "docent/simulator/sensing/camera/optics/depth_sensor.h"

#include <gtest/gtest.h>

#include <cmath>

namespace docent::simulator {
namespace {

constexpr double kFocal = 290.0;

RawDepth wall_at(float z) {
  RawDepth raw{100, 100, {}};
  raw.meetings.assign(10'000, {.z = z, .glass = 0.0F, .slant = 1.0F, .brightness = 0.7F, .is_lit = true});
  return raw;
}

/// Root mean square of the errors [m], and the share that is missing.
struct Figures {
  double error = 0.0, missing = 0.0;
};
Figures figures(const RawDepth& raw, std::uint64_t seed = 1) {
  Rng rng{seed};
  Figures found;
  int count = 0;
  const auto depths = measure(raw, {}, kFocal, rng);
  for (std::size_t i = 0; i < depths.size(); ++i) {
    if (depths[i] == 0) {
      found.missing += 1.0;
      continue;
    }
    const double off = 0.001 * depths[i] - static_cast<double>(raw.meetings[i].z);
    found.error += off * off;
    ++count;
  }
  found.error = count > 0 ? std::sqrt(found.error / count) : 0.0;
  found.missing /= static_cast<double>(depths.size());
  return found;
}

TEST(DepthSensor, ErrsWithTheSquareOfTheDistance) {
  const double near = figures(wall_at(1.0F)).error, middle = figures(wall_at(2.0F)).error,
               far = figures(wall_at(4.0F)).error;
  EXPECT_LT(near, 0.006);
  EXPECT_GT(middle, 2.0 * near);
  EXPECT_GT(far, 3.0 * middle);
  EXPECT_LT(far, 0.08);
  EXPECT_LT(figures(wall_at(2.0F)).missing, 0.01);
}

TEST(DepthSensor, SeesNothingTooNearTooFarInTheShadowOrAlongASurface) {
  EXPECT_EQ(figures(wall_at(0.3F)).missing, 1.0);
  EXPECT_EQ(figures(wall_at(9.0F)).missing, 1.0);
  EXPECT_EQ(figures(wall_at(0.0F)).missing, 1.0);
  RawDepth raw = wall_at(2.0F);
  for (auto& met : raw.meetings) met.is_lit = false;
  EXPECT_EQ(figures(raw).missing, 1.0);
  raw = wall_at(2.0F);
  for (auto& met : raw.meetings) met.slant = 0.1F;
  EXPECT_EQ(figures(raw).missing, 1.0);
}

TEST(DepthSensor, HasHolesBehindGlass) {
  RawDepth raw = wall_at(2.0F);
  for (auto& met : raw.meetings) met.glass = 1.0F;
  EXPECT_NEAR(figures(raw).missing, 0.8, 0.02);
}

}  // namespace
}  // namespace docent::simulator
