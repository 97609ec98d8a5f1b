#include "docent/messages/scanners/zero_meaning.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace docent {
namespace {

constexpr double kStep = std::numbers::pi / 180.0;
constexpr double kReach = 4.0;

/// A scanner of 360 beams, turned by `heading` degrees, in the middle of an oblong hall of 20 x 6 m: walls beside it,
/// and nothing within reach along it.
std::vector<float> hall(int heading, float nothing) {
  std::vector<float> ranges;
  for (int beam = 0; beam < 360; ++beam) {
    const double bearing = kStep * (beam + heading);
    const double range =
        std::min(10.0 / std::max(std::abs(std::cos(bearing)), 1e-9), 3.0 / std::max(std::abs(std::sin(bearing)), 1e-9));
    ranges.push_back(range < kReach ? static_cast<float>(range) : nothing);
  }
  return ranges;
}

TEST(ZeroMeaning, WallsThatRunOutOfReachTellARobotThatStands) {
  ZeroMeaning meaning;
  for (int sweep = 0; sweep < 4; ++sweep) meaning.add(hall(0, 0.0F), kStep, 0.1, kReach);
  EXPECT_EQ(meaning.found(), ZeroMeans::find_out);
  for (int sweep = 0; sweep < 4; ++sweep) meaning.add(hall(0, 0.0F), kStep, 0.1, kReach);
  EXPECT_EQ(meaning.found(), ZeroMeans::nothing);
}

TEST(ZeroMeaning, EdgesThatWanderTellARobotThatTurns) {
  // The driver says 40 m and sees 4: no reading is near its reach.
  ZeroMeaning meaning;
  for (int sweep = 0; sweep < 6; ++sweep) meaning.add(hall(0, 0.0F), kStep, 0.1, 40.0);
  EXPECT_EQ(meaning.found(), ZeroMeans::find_out) << "nothing has moved";
  for (int sweep = 0; sweep < 12; ++sweep) meaning.add(hall(7 * sweep, 0.0F), kStep, 0.1, 40.0);
  EXPECT_EQ(meaning.found(), ZeroMeans::nothing);
}

TEST(ZeroMeaning, ADriverWithAnotherWordForNothingMeansNoneByZero) {
  for (const float nothing : {std::numeric_limits<float>::infinity(), static_cast<float>(kReach)}) {
    ZeroMeaning meaning;
    for (int sweep = 0; sweep < 20; ++sweep) {
      auto ranges = hall(7 * sweep, nothing);
      for (std::size_t i = 0; i < 30; ++i) ranges[(i + 7 * static_cast<std::size_t>(sweep)) % 360] = 0.0F;
      meaning.add(ranges, kStep, 0.1, kReach);
    }
    EXPECT_EQ(meaning.found(), ZeroMeans::failed);
  }
}

TEST(ZeroMeaning, WhatIsCoveredStaysNoReadingHoweverTheRobotTurns) {
  ZeroMeaning meaning;
  for (int sweep = 0; sweep < 200; ++sweep) {
    std::vector<float> ranges(360);
    for (std::size_t i = 0; i < 360; ++i) {
      const double bearing = kStep * (static_cast<double>(i) + 7.0 * sweep);
      ranges[i] = static_cast<float>(2.0 + 0.5 * std::sin(bearing));
      if (i >= 100 && i < 160) ranges[i] = 0.0F;
    }
    meaning.add(ranges, kStep, 0.1, kReach);
  }
  EXPECT_EQ(meaning.found(), ZeroMeans::find_out);
}

TEST(ZeroMeaning, AClothThatFallsOverItIsNoAnswerAboutTheHall) {
  ZeroMeaning meaning;
  for (int sweep = 0; sweep < 200; ++sweep) {
    std::vector<float> ranges(360, 2.0F);
    if (sweep % 20 >= 10)
      for (std::size_t i = 60; i < 260; ++i) ranges[i] = 0.0F;
    meaning.add(ranges, kStep, 0.1, kReach);
  }
  EXPECT_EQ(meaning.found(), ZeroMeans::find_out);
}

TEST(ZeroMeaning, WhatComesTooNearHasNearNeighbours) {
  ZeroMeaning meaning;
  for (int sweep = 0; sweep < 200; ++sweep) {
    std::vector<float> ranges(360, 2.0F);  // somebody's leg goes round the scanner
    for (std::size_t i = 0; i < 60; ++i)
      ranges[(i + 7 * static_cast<std::size_t>(sweep)) % 360] = i < 15 || i >= 45 ? 0.2F : 0.0F;
    meaning.add(ranges, kStep, 0.15, kReach);
  }
  EXPECT_EQ(meaning.found(), ZeroMeans::find_out);
}

}  // namespace
}  // namespace docent
