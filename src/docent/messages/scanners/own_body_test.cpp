#include "docent/messages/scanners/own_body.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "docent/base/random.h"

namespace docent {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// 360 beams; a post 0.15 m before the scanner's beams 90 to 95, and a wall `wall` away.
std::vector<float> sweep_of(Rng& rng, double wall) {
  std::vector<float> ranges;
  for (int beam = 0; beam < 360; ++beam)
    ranges.push_back(static_cast<float>((beam >= 90 && beam < 96 ? 0.15 : wall) + rng.normal(0.0, 0.015)));
  return ranges;
}

TEST(OwnBody, LearnsAPostAndTakesItOut) {
  Rng rng{1};
  OwnBody body{Pose2{0.05, 0.0, {}}, 0.265, {}};
  for (int sweep = 0; sweep < 10; ++sweep) {
    auto ranges = sweep_of(rng, 2.0);
    body.take_out(ranges, -std::numbers::pi, kDegree, 0.05);
    EXPECT_FALSE(std::isnan(ranges[92])) << "not yet";
  }
  for (int sweep = 0; sweep < 50; ++sweep) {
    auto ranges = sweep_of(rng, 1.0 + 0.05 * sweep);
    body.take_out(ranges, -std::numbers::pi, kDegree, 0.05);
    ASSERT_EQ(body.taken_out().size(), 360U);
    for (std::size_t beam = 0; beam < 360; ++beam) {
      EXPECT_EQ(std::isnan(ranges[beam]), beam >= 90 && beam < 96) << beam;
      EXPECT_EQ(body.taken_out()[beam], beam >= 90 && beam < 96) << beam;
    }
  }
  EXPECT_FALSE(body.is_too_much());
  EXPECT_FALSE(body.where().empty());
}

TEST(OwnBody, GrazingReadingsAtTheEndsOfTheFieldAndBesideNothing) {
  constexpr float kInf = std::numeric_limits<float>::infinity();
  std::vector<float> ranges{0.5F, 2.0F, 2.0F, 0.0F, 0.7F, kInf, 4.0F, kInf};
  const std::vector<bool> grazes{true, false, false, false, true, true, false, false};
  take_out_grazing(ranges, grazes);
  EXPECT_TRUE(std::isnan(ranges[0]));
  EXPECT_TRUE(std::isnan(ranges[4])) << "0 says nothing; 2 m and 4 m do";
  EXPECT_EQ(ranges[5], kInf);
  EXPECT_EQ(ranges[1], 2.0F);
}

TEST(OwnBody, WhatStandsBesideTheRobotIsNone) {
  Rng rng{2};
  OwnBody body{Pose2{}, 0.265, {}};
  for (int sweep = 0; sweep < 30; ++sweep) {
    std::vector<float> ranges;  // a wall that the robot touches when it begins
    for (int beam = 0; beam < 360; ++beam) {
      const double across = std::abs(beam - 180) < 60 ? 0.27 / std::cos(kDegree * (beam - 180)) : 3.0;
      ranges.push_back(static_cast<float>(across + rng.normal(0.0, 0.01)));
    }
    const auto before = ranges;
    body.take_out(ranges, -std::numbers::pi, kDegree, 0.05);
    EXPECT_EQ(ranges, before);
  }
  EXPECT_EQ(body.where(), "");
}

TEST(OwnBody, WhatComesLaterIsNone) {
  Rng rng{3};
  OwnBody body{Pose2{}, 0.265, {}};
  for (int sweep = 0; sweep < 10; ++sweep) {
    auto ranges = sweep_of(rng, 2.0);
    body.take_out(ranges, -std::numbers::pi, kDegree, 0.05);
  }
  auto ranges = sweep_of(rng, 2.0);
  for (std::size_t beam = 200; beam < 220; ++beam) ranges[beam] = 0.2F;  // a hand
  body.take_out(ranges, -std::numbers::pi, kDegree, 0.05);
  for (std::size_t beam = 200; beam < 220; ++beam) EXPECT_EQ(ranges[beam], 0.2F);
}

TEST(OwnBody, ASlimBodyEndsAtItsOutline) {
  const Polygon slim{{0.4, -0.1}, {0.4, 0.1}, {-0.4, 0.1}, {-0.4, -0.1}};
  OwnBody body{Pose2{}, 0.42, slim};
  std::vector<float> ranges(360, 0.25F);  // within the disc; ahead and behind within the outline, beside not
  for (int sweep = 0; sweep < 11; ++sweep) {
    ranges.assign(360, 0.25F);
    for (std::size_t beam = 45; beam < 315; ++beam) ranges[beam] = beam < 225 && beam >= 135 ? 2.0F : 0.25F;
    for (std::size_t beam = 0; beam < 45; ++beam) ranges[beam] = ranges[beam + 315] = 2.0F;
    body.take_out(ranges, 0.0, kDegree, 0.05);
  }
  EXPECT_EQ(ranges[90], 0.25F);
  EXPECT_EQ(body.where(), "");
}

TEST(OwnBody, ACoveredScannerIsNoBody) {
  OwnBody body{Pose2{}, 0.265, {}};
  std::vector<float> ranges;
  for (int sweep = 0; sweep < 20; ++sweep) {
    ranges.assign(360, 2.0F);
    for (std::size_t beam = 0; beam < 200; ++beam) ranges[beam] = 0.06F;
    body.take_out(ranges, 0.0, kDegree, 0.05);
  }
  EXPECT_EQ(ranges[100], 0.06F) << "an obstacle, as before";
  EXPECT_TRUE(body.is_too_much());
}

}  // namespace
}  // namespace docent
