#include "docent/sensor_models/range_sweep.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace docent::sensor_models {
namespace {

TEST(RangeSweep, BringsAnOffsetLaserToTheCentre) {
  RangeSweep sweep;
  const std::array<float, 1> ranges{1.0F};
  append(sweep, {ranges, Angle::degrees(90), 0.0}, {0.25, 0.0, Angle{}});  // a laser at the front that looks left
  ASSERT_EQ(sweep.beams.size(), 1U);
  EXPECT_NEAR(sweep.beams[0].range, std::hypot(0.25, 1.0), 1e-9);
  EXPECT_NEAR(sweep.beams[0].bearing, std::atan2(1.0, 0.25), 1e-9);
  EXPECT_NEAR(endpoint(sweep.beams[0]).x, 0.25, 1e-9);
  EXPECT_NEAR(endpoint(sweep.beams[0]).y, 1.0, 1e-9);
}

TEST(RangeSweep, RearLaserLooksBack) {
  RangeSweep sweep;
  const std::array<float, 1> ranges{2.0F};
  append(sweep, {ranges, Angle{}, 0.0}, {0.0, 0.0, Angle::degrees(180)});
  EXPECT_NEAR(endpoint(sweep.beams.at(0)).x, -2.0, 1e-9);
}

TEST(RangeSweep, DropsInvalidAndMarksNoReturn) {
  RangeSweep sweep;
  const std::array<float, 5> ranges{std::nanf(""), 0.0F, 10.0F, std::numeric_limits<float>::infinity(), -1.0F};
  append(sweep, {ranges, Angle{}, 0.1}, {});
  ASSERT_EQ(sweep.beams.size(), 2U);
  EXPECT_TRUE(sweep.beams[0].no_return && sweep.beams[1].no_return);
  EXPECT_EQ(sweep.beams[1].range, 10.0);
}

TEST(RangeSweep, NothingIsExpectedBeyondTheReach) {
  const RangeSweep sweep = within_reach(
      {{{0.0, 9.9, false}, {0.1, 10.0, false}, {0.2, 25.0, false}, {0.3, 80.0, true}, {0.4, 4.0, true}}}, 10.0);
  ASSERT_EQ(sweep.beams.size(), 5U);
  EXPECT_FALSE(sweep.beams[0].no_return);
  for (const std::size_t far : {1U, 2U, 3U}) {
    EXPECT_TRUE(sweep.beams[far].no_return);
    EXPECT_EQ(sweep.beams[far].range, 10.0);
    EXPECT_DOUBLE_EQ(sweep.beams[far].bearing, 0.1 * static_cast<double>(far));
  }
  EXPECT_TRUE(sweep.beams[4].no_return);
  EXPECT_EQ(sweep.beams[4].range, 4.0) << "who looks less far says nothing of 10 m";
}

TEST(RangeSweep, TwoLasersFillEveryDirectionOnce) {
  std::array<float, 180> ranges{};
  ranges.fill(3.0F);
  RangeSweep sweep;
  for (const double heading : {0.0, 180.0})
    append(sweep, {ranges, Angle::degrees(-89.5), std::numbers::pi / 180.0}, {0.0, 0.0, Angle::degrees(heading)});
  for (const double turn : {0.0, 0.013, -0.8}) {
    const RangeSweep turned = seen_from(sweep, {0.0, 0.0, Angle::radians(turn)});
    const auto beams = binned(turned, 180);
    ASSERT_EQ(beams.size(), 180U);
    for (const BinnedBeam& beam : beams) {
      const double middle = beam.direction * std::numbers::pi / 90.0;
      const double off = Angle::radians(turned.beams[beam.beam].bearing - middle).degrees();
      EXPECT_LE(std::abs(off), 0.5 + 1e-6);  // of two beams in a direction the nearer to its middle
    }
  }
}

TEST(RangeSweep, SeenFromElsewhereTheEndsStayWhereTheyAre) {
  RangeSweep sweep;
  const std::array<float, 4> ranges{1.0F, 2.0F, 3.0F, 20.0F};
  append(sweep, {ranges, Angle::degrees(-60), 0.7}, {0.1, 0.0, Angle{}});
  const Pose2 there_from_here{0.2, -0.1, Angle::degrees(25)};
  const RangeSweep there = seen_from(sweep, there_from_here);
  ASSERT_EQ(there.beams.size(), 4U);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_LT(distance(endpoint(there.beams[i]), there_from_here * endpoint(sweep.beams[i])), 1e-9);
  EXPECT_TRUE(there.beams[3].no_return);
  EXPECT_NEAR(there.beams[3].bearing - sweep.beams[3].bearing, 25.0 * std::numbers::pi / 180.0, 1e-9);
}

}  // namespace
}  // namespace docent::sensor_models
