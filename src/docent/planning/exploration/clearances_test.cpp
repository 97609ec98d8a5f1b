#include "docent/planning/exploration/clearances.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace docent::planning::clearances_test {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

std::size_t towards(double degrees) { return static_cast<std::size_t>(std::lround((degrees + 180.0) / 2.0)) % 180; }

/// All round, every 2 degrees: 3 m, but 1 m ahead of the sensor.
std::vector<float> sweep() {
  std::vector<float> ranges(180, 3.0F);
  ranges[90] = 1.0F;
  return ranges;
}

Clearances seen(const Pose2& base_from_sensor, const std::vector<float>& ranges) {
  Clearances clearances;
  clearances.add(base_from_sensor, -std::numbers::pi, 2.0 * kDegree, 6.0, ranges);
  return clearances;
}

TEST(Clearances, WithoutMotionTheSweepItself) {
  const auto free = seen({}, sweep()).free();
  ASSERT_EQ(free.size(), Clearances::kDirections);
  for (std::size_t i = 0; i < free.size(); ++i) EXPECT_NEAR(free[i], i == 90 ? 1.0 : 3.0, 1e-6) << i;
}

TEST(Clearances, WhatWasAheadLiesAsideOfABaseThatHasTurned) {
  for (const double turned : {7.0, 30.0, 90.5, -45.0}) {
    SCOPED_TRACE(turned);
    const auto free = seen({0.0, 0.0, Angle::degrees(-turned)}, sweep()).free();
    EXPECT_NEAR(free[towards(-turned)], 1.0, 1e-6);
    EXPECT_NEAR(free[towards(0.0)], 3.0, 1e-6);
    EXPECT_GT(*std::min_element(free.begin(), free.end()), 0.9) << "no gap";
  }
}

TEST(Clearances, AndNearerToOneThatHasDriven) { EXPECT_NEAR(seen({-0.4, 0.0, {}}, sweep()).free()[90], 0.6, 1e-6); }

TEST(Clearances, WhereNothingIsReadNowWhatWasReadBefore) {
  auto half = sweep();
  std::fill(half.begin(), half.begin() + 40, std::numeric_limits<float>::quiet_NaN());
  auto now = seen({}, half);
  now.fill(seen({}, std::vector<float>(180, 2.0F)));
  const auto free = now.free();
  EXPECT_NEAR(free[20], 2.0, 1e-6);
  EXPECT_NEAR(free[90], 1.0, 1e-6);
  EXPECT_NEAR(free[120], 3.0, 1e-6) << "what is read now counts";
}

TEST(Clearances, NothingReadIsNothingFree) {
  EXPECT_EQ(Clearances{}.free(), std::vector<double>(180, 0.0));
  auto ranges = sweep();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::fill(ranges.begin() + 20, ranges.begin() + 30, nan);
  ranges[120] = std::numeric_limits<float>::infinity();
  const auto free = seen({}, ranges).free();
  for (std::size_t i = 20; i < 30; ++i) EXPECT_EQ(free[i], 0.0) << i;
  EXPECT_NEAR(free[19], 3.0, 1e-6);
  EXPECT_EQ(free[120], 6.0) << "nothing as far as it reaches";
}

}  // namespace
}  // namespace docent::planning::clearances_test
