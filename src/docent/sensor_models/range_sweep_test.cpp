#include "docent/sensor_models/range_sweep.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace docent {
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

TEST(RangeSweep, TwoLasersFillEveryDirectionOnce) {
  std::array<float, 180> ranges{};
  ranges.fill(3.0F);
  RangeSweep sweep;
  for (const double heading : {0.0, 180.0})
    append(sweep, {ranges, Angle::degrees(-89.5), std::numbers::pi / 180.0}, {0.0, 0.0, Angle::degrees(heading)});
  for (const double turn : {0.0, 0.013, -0.8}) {
    const auto beams = binned(sweep, 180, turn);
    ASSERT_EQ(beams.size(), 180U);
    for (const BinnedBeam& beam : beams) {
      const double middle = beam.direction * std::numbers::pi / 90.0;
      const double off = Angle::radians(sweep.beams[beam.beam].bearing + turn - middle).degrees();
      EXPECT_LE(std::abs(off), 0.5 + 1e-6);  // of two beams in a direction the nearer to its middle
    }
  }
}

}  // namespace
}  // namespace docent
