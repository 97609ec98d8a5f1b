#include "docent/planning/survey/keyframes.h"

#include <gtest/gtest.h>

#include "docent/planning/survey/testing.h"

namespace docent::planning::keyframes_test {
namespace {

/// A robot with two lasers in a room; odometry is the map's frame.
class Keyframes : public ::testing::Test {
 protected:
  void stand_at(const Pose2& pose, double at_s) {
    now = time_from_seconds(at_s);
    odometry.add(now, {pose, {}});
    see(1, pose, now);
    see(0, pose, now);
  }
  void see(std::size_t laser, const Pose2& pose, Time stamp) {
    const auto ranges = testing::ranges_in_room(pose * testing::two_lasers()[laser]);
    keyframes.keep(laser, stamp, testing::reading_of(ranges));
  }

  Time now{};
  collision_avoidance::BaseHistory odometry;
  planning::Keyframes keyframes{{}, {}, testing::two_lasers()};
};

TEST_F(Keyframes, TheMapBeginsWithAllLasers) {
  odometry.add(now, {{1.5, 2.0, {}}, {}});
  see(0, {1.5, 2.0, {}}, now);
  EXPECT_FALSE(keyframes.take(odometry, {}));
  EXPECT_TRUE(keyframes.look(odometry)) << "but it is something to look at";
  see(1, {1.5, 2.0, {}}, now);
  const auto frame = keyframes.take(odometry, {});
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->sweeps.size(), 2U);
  EXPECT_EQ(frame->scan.sensors.size(), 2U);
  EXPECT_EQ(frame->stamp, now);
  EXPECT_EQ(frame->scan.odom_from_base.x, 1.5);
}

TEST_F(Keyframes, WithoutOdometryNothingHasAPlace) {
  see(0, {1.5, 2.0, {}}, now);
  see(1, {1.5, 2.0, {}}, now);
  EXPECT_FALSE(keyframes.look(odometry));
  EXPECT_FALSE(keyframes.take(odometry, {}));
}

TEST_F(Keyframes, AMomentIsWorthKeepingAfterSomeWayOrTurnOrTime) {
  const auto is_kept = [&](const Pose2& pose, double at_s) {
    stand_at(pose, at_s);
    return keyframes.take(odometry, {}).has_value();
  };
  EXPECT_TRUE(is_kept({1.5, 2.0, {}}, 0.0));
  EXPECT_FALSE(is_kept({1.6, 2.0, {}}, 1.0));
  EXPECT_TRUE(is_kept({1.71, 2.0, {}}, 2.0)) << "20 cm";
  EXPECT_FALSE(is_kept({1.71, 2.0, Angle::degrees(9.0)}, 3.0));
  EXPECT_TRUE(is_kept({1.71, 2.0, Angle::degrees(11.0)}, 4.0)) << "10 degrees";
  EXPECT_FALSE(is_kept({1.71, 2.0, Angle::degrees(11.0)}, 8.9));
  EXPECT_TRUE(is_kept({1.71, 2.0, Angle::degrees(11.0)}, 9.0)) << "5 s";
}

TEST_F(Keyframes, ALaserOfAnotherMomentIsLeftOut) {
  stand_at({1.5, 2.0, {}}, 1.0);
  EXPECT_EQ(keyframes.look(odometry)->sweep.beams.size(), 2U * 181U);
  odometry.add(time_from_seconds(1.5), {{1.5, 2.0, {}}, {}});
  see(0, {1.5, 2.0, {}}, time_from_seconds(1.5));
  EXPECT_EQ(keyframes.look(odometry)->sweep.beams.size(), 181U);
}

TEST_F(Keyframes, WhatTheOtherLaserSawIsMovedByOdometry) {
  const Pose2 then{1.5, 2.0, {}};
  const Pose2 here{1.6, 2.0, {}};
  odometry.add(time_from_seconds(1.0), {then, {1.0, 0.0}});
  odometry.add(time_from_seconds(1.1), {here, {1.0, 0.0}});
  see(1, then, time_from_seconds(1.0));
  see(0, here, time_from_seconds(1.1));
  const auto look = keyframes.look(odometry);
  ASSERT_TRUE(look);
  EXPECT_NEAR(look->odom_from_base.x, 1.6, 1e-9);
  for (const auto& beam : look->sweep.beams) {
    const Point2 end = here * endpoint(beam);
    const double off =
        std::min({std::abs(end.x - 0.02), std::abs(end.x - 6.02), std::abs(end.y - 0.02), std::abs(end.y - 4.02)});
    EXPECT_LT(off, 1e-3) << "every beam ends on a wall";
  }
}

TEST_F(Keyframes, WhatIsSeenOfPeopleBelongsToNoMap) {
  stand_at({1.5, 2.0, {}}, 0.0);
  const std::vector<Point2> people{{6.0, 2.0}};
  const auto frame = keyframes.take(odometry, people);
  ASSERT_TRUE(frame);
  EXPECT_LT(frame->sweeps[0].sweep.beams.size(), 181U);
  EXPECT_GT(frame->sweeps[0].sweep.beams.size(), 150U);
  for (const auto& beam : frame->sweeps[0].sweep.beams)
    EXPECT_GE(distance(Pose2{1.5, 2.0, {}} * endpoint(beam), people[0]), 0.5);
  EXPECT_EQ(frame->sweeps[1].sweep.beams.size(), 181U) << "nobody stands behind";
}

TEST(KeyframeParams, SaysWhatIsWrong) {
  EXPECT_TRUE(KeyframeParams{}.validate());
  EXPECT_EQ(KeyframeParams{.way = 0.0}.validate().error().message, "way must be > 0 m");
  EXPECT_EQ(KeyframeParams{.person = -1.0}.validate().error().message, "person must be >= 0 m");
}

}  // namespace
}  // namespace docent::planning::keyframes_test
