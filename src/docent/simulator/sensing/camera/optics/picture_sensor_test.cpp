#include "docent/simulator/sensing/camera/optics/picture_sensor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace docent::simulator {
namespace {

RawPicture sheet(float light, Vec3 ray = {0.0F, 0.0F, 1.0F}) {
  return {80, 50, std::vector<Rgb>(4000, Rgb{light, light, light}), std::vector<Vec3>(4000, ray)};
}

struct Spread {
  double mean, deviation;
};
Spread spread_of(const std::vector<std::uint8_t>& grey) {
  const double mean = std::accumulate(grey.begin(), grey.end(), 0.0) / static_cast<double>(grey.size());
  double square = 0.0;
  for (const std::uint8_t g : grey) square += (g - mean) * (g - mean);
  return {mean, std::sqrt(square / static_cast<double>(grey.size()))};
}

PictureSensor linear() { return {.gain = 1.0, .vignetting = 0.0, .gamma = 1.0}; }

TEST(PictureSensor, NoiseIsAsLargeAsItSaysAndGrowsWithLight) {
  for (const float light : {0.1F, 0.5F, 0.8F}) {
    Rng rng{1};
    PictureSensor sensor = linear();
    sensor.read_noise = 0.01, sensor.shot_noise = 0.04;
    const Spread seen = spread_of(develop_grey(sheet(light), sensor, rng));
    EXPECT_NEAR(seen.mean, 255.0 * light, 0.6) << light;
    EXPECT_NEAR(seen.deviation, 255.0 * std::sqrt(1e-4 + 16e-4 * light), 0.4) << light;
  }
}

TEST(PictureSensor, GainAndVignettingScaleLightAndWhiteIsTheMost) {
  PictureSensor sensor = linear();
  sensor.read_noise = sensor.shot_noise = 0.0;
  Rng rng{1};
  sensor.gain = 2.0;
  EXPECT_NEAR(spread_of(develop_grey(sheet(0.2F), sensor, rng)).mean, 102.0, 0.6);
  EXPECT_EQ(spread_of(develop_grey(sheet(3.0F), sensor, rng)).mean, 255.0);
  sensor.gain = 1.0;
  sensor.vignetting = 0.4;
  const float half = std::sqrt(0.5F);
  EXPECT_NEAR(spread_of(develop_grey(sheet(0.5F, {half, 0.0F, half}), sensor, rng)).mean, 0.6 * 127.5, 0.6);
  EXPECT_EQ(spread_of(develop_grey(sheet(0.5F, {0.0F, 0.0F, 0.0F}), sensor, rng)).mean, 0.0) << "outside the lens";
}

TEST(PictureSensor, ExposureGoesBySteps) {
  const auto gains = stepped_gains(1000, 0.02, 1.0, Rng{4});
  int steps = 0;
  for (std::size_t i = 1; i < gains.size(); ++i) steps += gains[i] != gains[i - 1] ? 1 : 0;
  EXPECT_GT(steps, 8);
  EXPECT_LT(steps, 40);
  for (const double gain : gains) {
    EXPECT_GE(gain, 0.5);
    EXPECT_LE(gain, 2.0);
  }
}

TEST(PictureSensor, AMovingCameraSeesTheMean) {
  const std::vector<RawPicture> both{sheet(0.2F), sheet(0.6F)};
  EXPECT_NEAR(mean_of(both).light.front().green, 0.4F, 1e-6F);
}

}  // namespace
}  // namespace docent::simulator
