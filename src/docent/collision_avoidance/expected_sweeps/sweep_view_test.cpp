#include "docent/collision_avoidance/expected_sweeps/sweep_view.h"

#include <gtest/gtest.h>

#include <cmath>

#include "docent/collision_avoidance/expected_sweeps/room_for_test.h"

namespace docent::collision_avoidance::sweep_view_test {
namespace {

TEST(SweepView, KeepsEveryBeamOfASmallSweepAndThinsALargeOne) {
  SensorSweep sweep{time_from_seconds(1.0), {}, -1.0, 0.01, 0.1, 5.0, {}};
  sweep.ranges.assign(200, 2.0F);
  sweep.ranges[10] = std::nanf("");
  sweep.ranges[20] = 0.05F;  // below min_range: no reading
  sweep.ranges[30] = 5.0F;   // max_range: no answer
  const SweepView whole = view_of(sweep, {}, 200);
  ASSERT_EQ(whole.ranges.size(), 200U);
  EXPECT_TRUE(std::isnan(whole.ranges[10]));
  EXPECT_TRUE(std::isnan(whole.ranges[20]));
  EXPECT_EQ(whole.ranges[30], kNoAnswer);
  EXPECT_FALSE(whole.met(30));
  EXPECT_EQ(whole.answers, 197);
  EXPECT_EQ(whole.nearest[31], 2.0F);
  EXPECT_EQ(whole.farthest[31], kNoAnswer);
  const SweepView thin = view_of(sweep, {}, 50);
  ASSERT_EQ(thin.ranges.size(), 50U);
  EXPECT_NEAR(thin.bearing_step, 0.04, 1e-12);
  EXPECT_EQ(thin.sample_to(thin.place(25)), 25);
}

TEST(SweepView, TheRaysOfTheLastSweepServeAsLongAsItsFormStays) {
  SensorSweep sweep{time_from_seconds(1.0), {}, -1.0, 0.01, 0.1, 5.0, std::vector<float>(180, 2.0F)};
  const SweepView first = view_of(sweep, {});
  EXPECT_EQ(view_of(sweep, {}, 180, first.rays).rays, first.rays);
  const auto expect_own_rays = [&] {
    const SweepView other = view_of(sweep, {}, 180, first.rays);
    EXPECT_NE(other.rays, first.rays);
    ASSERT_EQ(other.rays->units.size(), other.ranges.size());
    const double last = other.first_bearing + static_cast<double>(other.ranges.size() - 1) * other.bearing_step;
    EXPECT_EQ(other.place(other.ranges.size() - 1), 2.0 * unit(Angle::radians(last)));
  };
  sweep.first_bearing = -0.9;
  expect_own_rays();
  sweep = {time_from_seconds(1.0), {}, -1.0, 0.02, 0.1, 5.0, std::vector<float>(180, 2.0F)};
  expect_own_rays();
  sweep = {time_from_seconds(1.0), {}, -1.0, 0.01, 0.1, 5.0, std::vector<float>(120, 2.0F)};
  expect_own_rays();
}

TEST(SweepView, WhatStandsStillIsExpectedWhereItIs) {
  RoomForTest room;
  room.noise = 0.0;
  room.box(-3, -4, 6, 4);
  const Pose2 then{0.0, 0.0, {}};
  const Pose2 now{0.4, 0.2, Angle::degrees(20)};
  const SweepView seen = view_of(room.sweep(1.0, then), then);
  const SweepView view = view_of(room.sweep(1.5, now), now);
  std::vector<float> expected;
  expect(seen, inverse(now) * then, view, expected);
  ASSERT_EQ(expected.size(), view.ranges.size());
  int known = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (std::isnan(expected[i])) continue;
    ++known;
    EXPECT_NEAR(expected[i], view.ranges[i], 0.15) << i;
  }
  EXPECT_GT(known, 100);
  EXPECT_TRUE(std::isnan(expected.back()));  // it has turned to the left: nothing was seen there
}

TEST(SweepView, WallsAreWhatIsStraightAndWiderThanAPerson) {
  RoomForTest room;
  room.box(-3, -4, 6, 4);
  room.discs = {{{2.0, 0.0}, 0.25}};
  const SweepView view = view_of(room.sweep(1.0, {}), {});
  const SweepView walls = walls_of(view);
  EXPECT_TRUE(std::isnan(walls.ranges[90]));  // the person ahead
  EXPECT_EQ(walls.ranges[45], view.ranges[45]);
}

}  // namespace
}  // namespace docent::collision_avoidance::sweep_view_test
