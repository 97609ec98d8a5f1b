#include "docent/collision_avoidance/virtual_measurements/carried_ranges.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace docent::collision_avoidance {
namespace {

using Ranges = VirtualMeasurements::Ranges;
constexpr int kAhead = VirtualMeasurements::kDirections / 2;

/// A plate of 1 x 2 m, in a hall of 20 x 20 m whose border counts as well, from one certain pose.
Ranges seen_from(const Pose2& pose) {
  VirtualMeasurementParams params;
  params.cell_padding = 0.0;
  VirtualMeasurements measurements{
      {{0, 0}, {20, 0}, {20, 20}, {0, 20}}, {{{10, 9}, {11, 9}, {11, 11}, {10, 11}}}, params};
  const WeightedPose here{pose.position(), pose.theta.radians(), 1.0};
  return measurements.measure({&here, 1}, {}).ranges;
}

TEST(CarriedRanges, WithoutMotionNothingChanges) {
  const Ranges measured = seen_from({8.0, 10.0, {}});
  const Ranges same = carried(measured, {});
  for (std::size_t i = 0; i < measured.size(); ++i) EXPECT_NEAR(same[i], measured[i], 1e-9) << i;
}

TEST(CarriedRanges, AfterSomeDecimetresTheyAreWhatAMeasurementThereWouldBe) {
  const Pose2 then{8.0, 9.6, Angle::degrees(10.0)};
  for (const Pose2 step :
       {Pose2{0.25, 0.0, {}}, Pose2{0.2, 0.05, Angle::degrees(20.0)}, Pose2{0.0, 0.0, Angle::degrees(-31.0)}}) {
    const Ranges wanted = seen_from(then * step);
    const Ranges got = carried(seen_from(then), step);
    int near = 0;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      // At a corner of the plate a direction is the plate's or the border's behind it.
      const double left = wanted[(i + wanted.size() - 1) % wanted.size()], right = wanted[(i + 1) % wanted.size()];
      const double least = std::min({left, wanted[i], right}), most = std::max({left, wanted[i], right});
      EXPECT_GT(got[i], least - 0.2) << i;
      EXPECT_LT(got[i], most + 0.2) << i;
      near += wanted[i] < 3.0 ? 1 : 0;
    }
    EXPECT_GT(near, 10) << "the plate is seen";
  }
}

TEST(CarriedRanges, WhatLiesAheadComesNearerAndWhatLiesBehindGoes) {
  Ranges measured;
  measured.fill(VirtualMeasurements::kMaxRange);
  measured[kAhead] = 1.0;
  measured[0] = 2.0;
  const Ranges got = carried(measured, {0.3, 0.0, {}});
  EXPECT_NEAR(got[kAhead], 0.7, 1e-9);
  EXPECT_NEAR(got[0], 2.3, 1e-9);
  EXPECT_EQ(got[kAhead + 10], VirtualMeasurements::kMaxRange);
}

TEST(CarriedRanges, AnEdgeThatIsDrivenUpToHasNoGaps) {
  Ranges wall;  // across the way, 1 m ahead
  for (int i = 0; i < VirtualMeasurements::kDirections; ++i) {
    const double bearing = (2.0 * i - 180.0) * std::numbers::pi / 180.0;
    wall[static_cast<std::size_t>(i)] =
        std::abs(bearing) < 1.2 ? 1.0 / std::cos(bearing) : VirtualMeasurements::kMaxRange;
  }
  const Ranges got = carried(wall, {0.7, 0.0, {}});
  for (int i = kAhead - 35; i <= kAhead + 35; ++i) {
    const double bearing = (2.0 * i - 180.0) * std::numbers::pi / 180.0;
    EXPECT_NEAR(got[static_cast<std::size_t>(i)], 0.3 / std::cos(bearing), 0.03) << i;
  }
}

}  // namespace
}  // namespace docent::collision_avoidance
