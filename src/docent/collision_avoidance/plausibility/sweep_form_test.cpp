#include "docent/collision_avoidance/plausibility/sweep_form.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "docent/collision_avoidance/expected_sweeps/room_for_test.h"

namespace docent::collision_avoidance::sweep_form_test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

class Forms : public ::testing::Test {
 protected:
  Forms() {
    room.box(-3, -3, 4, 3);
    sweep = room.sweep(1.0, {});
  }
  [[nodiscard]] SweepForm form() const { return form_of(sweep, sweep.min_range, limits); }
  RoomForTest room;
  BaseLimits limits;
  SensorSweep sweep;
};

TEST_F(Forms, OfAScannerInOrderShowsNothing) {
  EXPECT_FALSE(form().has_wrong_units);
  EXPECT_FALSE(form().is_covered);
  EXPECT_FALSE(form().is_silent);
  EXPECT_TRUE(form().too_near.empty());
}

TEST_F(Forms, MillimetresCentimetresAndKilometresAreWrongUnits) {
  for (const float factor : {1000.0F, 100.0F, 0.001F}) {
    sweep = room.sweep(1.0, {});
    for (float& range : sweep.ranges) range *= factor;
    EXPECT_TRUE(form().has_wrong_units) << factor;
  }
}

TEST_F(Forms, AConstantForNothingIsNoUnit) {
  for (const float nothing : {65.533F, 1e4F, 0.001F, kInfinity, 10.0F}) {
    sweep = room.sweep(1.0, {});
    for (std::size_t i = 0; i < 120; ++i) sweep.ranges[i] = nothing;
    EXPECT_FALSE(form().has_wrong_units) << nothing;
  }
  sweep = room.sweep(1.0, {});
  for (float& range : sweep.ranges) range *= 1.2F;  // a scanner that reaches farther than it states
  sweep.max_range = 4.0;
  EXPECT_FALSE(form().has_wrong_units);
}

TEST_F(Forms, NothingAllRoundIsSilenceAndAFewStraysToo) {
  sweep.ranges.assign(180, kInfinity);
  EXPECT_TRUE(form().is_silent);
  sweep.ranges[17] = 2.0F;
  EXPECT_TRUE(form().is_silent);
  for (std::size_t i = 40; i < 50; ++i) sweep.ranges[i] = 3.0F;
  EXPECT_FALSE(form().is_silent);
  sweep.ranges.assign(180, std::nanf(""));  // another watch's
  EXPECT_FALSE(form().is_silent);
}

TEST_F(Forms, WhatEndsWithinTheBodyCoversTheScanner) {
  for (std::size_t i = 60; i < 90; ++i) sweep.ranges[i] = 0.12F;
  EXPECT_TRUE(form().is_covered);
  sweep = room.sweep(1.0, {});
  for (std::size_t i = 60; i < 70; ++i) sweep.ranges[i] = 0.12F;  // 10 degrees: a cable
  EXPECT_FALSE(form().is_covered);
  sweep = room.sweep(1.0, {});
  for (std::size_t i = 60; i < 90; ++i) sweep.ranges[i] = 0.27F;  // somebody touches it
  EXPECT_FALSE(form().is_covered);
}

TEST_F(Forms, NothingBetweenTwoReadingsAtMinRangeIsTooNear) {
  sweep.min_range = 0.5;
  for (std::size_t i = 80; i < 100; ++i) sweep.ranges[i] = kInfinity;
  EXPECT_TRUE(form().too_near.empty());
  for (const std::size_t i : {78U, 79U, 100U, 101U}) sweep.ranges[i] = 0.52F;
  ASSERT_EQ(form().too_near.size(), 1U);
  EXPECT_EQ(form().too_near[0].first, 80U);
  EXPECT_EQ(form().too_near[0].end, 100U);
  sweep.min_range = 0.1;  // lies within the body: what is so near is the robot
  EXPECT_TRUE(form().too_near.empty());
  sweep.base_from_sensor = {0.25, 0.0, {}};
  EXPECT_TRUE(can_be_too_near(sweep, sweep.min_range, limits));
}

}  // namespace
}  // namespace docent::collision_avoidance::sweep_form_test
