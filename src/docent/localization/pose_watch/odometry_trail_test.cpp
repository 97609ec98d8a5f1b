#include "docent/localization/pose_watch/odometry_trail.h"

#include <gtest/gtest.h>

namespace docent::localization::odometry_trail_test {
namespace {

Time at(double s) { return time_from_seconds(100.0 + s); }

/// Two seconds straight on at 0.5 m/s, then an encoder that skips 3 m.
OdometryTrail torn_at_two_seconds() {
  OdometryTrail trail;
  for (int i = 0; i < 20; ++i) trail.add(at(0.1 * i), {0.05 * i, 0.0, {}});
  trail.add(at(2.0), {4.0, 0.0, {}});
  return trail;
}

TEST(OdometryTrail, IsTheOdometrysOwnUntilItJumps) {
  OdometryTrail trail;
  EXPECT_TRUE(trail.empty());
  EXPECT_FALSE(trail.at(at(0.0)));
  for (int i = 0; i < 20; ++i) trail.add(at(0.1 * i), {0.05 * i, 0.0, {}});
  EXPECT_NEAR(trail.at(at(1.05))->x, 0.525, 1e-9);
  EXPECT_NEAR(trail.in_raw({0.5, 0.0, {}}, at(1.0)).x, 0.5, 1e-9);
  EXPECT_EQ(trail.latest_time(), at(1.9));
  EXPECT_FALSE(trail.take_jump(at(1.9)));
}

TEST(OdometryTrail, AJumpIsNoWayButIsInWhatOthersGet) {
  const OdometryTrail trail = torn_at_two_seconds();
  EXPECT_NEAR(trail.latest().x, 1.0, 1e-6) << "it has driven on meanwhile";
  EXPECT_NEAR(trail.in_raw(trail.latest(), at(2.0)).x, 4.0, 1e-6);
  EXPECT_NEAR(trail.in_raw({0.95, 0.0, {}}, at(1.9)).x, 0.95, 1e-6) << "a scan of before";
}

TEST(OdometryTrail, AJumpIsTakenOnceByWhatWasSeenSince) {
  OdometryTrail trail = torn_at_two_seconds();
  EXPECT_FALSE(trail.take_jump(at(1.9)));
  EXPECT_TRUE(trail.take_jump(at(2.0)));
  EXPECT_FALSE(trail.take_jump(at(2.1)));
}

TEST(OdometryTrail, IsCarriedOnForAMoment) {
  OdometryTrail trail;
  for (int i = 0; i < 20; ++i) trail.add(at(0.05 * i), {0.0, 0.0, Angle::radians(0.06 * i)});
  EXPECT_NEAR(trail.at(at(1.05))->theta.radians(), 1.2 * 1.05, 1e-6);
  EXPECT_FALSE(trail.at(at(1.3)));
}

TEST(OdometryTrail, ClocksThatAreSetBackBeginAnewWithoutAJump) {
  OdometryTrail trail;
  for (int i = 0; i < 20; ++i) trail.add(at(0.1 * i), {0.05 * i, 0.0, {}});
  trail.add(at(1.85), {0.93, 0.0, {}});
  EXPECT_NEAR(trail.latest().x, 0.95, 1e-9) << "that one was overtaken";
  for (int i = 20; i < 25; ++i) trail.add(at(0.1 * i - 1.0), {0.05 * i, 0.0, {}});
  EXPECT_NEAR(trail.latest().x, 1.2, 1e-9);
  EXPECT_EQ(trail.latest_time(), at(1.4));
  EXPECT_FALSE(trail.at(at(1.0))) << "by which clock?";
  EXPECT_FALSE(trail.take_jump(at(1.4)));
}

}  // namespace
}  // namespace docent::localization::odometry_trail_test
