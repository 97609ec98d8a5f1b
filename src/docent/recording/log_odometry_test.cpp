#include "docent/recording/log_odometry.h"

#include <gtest/gtest.h>

namespace docent::recording::log_odometry_test {
namespace {

Time at(double time) { return time_from_seconds(100.0 + time); }

TEST(RisingStamps, StayAsTheyAre) {
  RisingStamps stamps;
  for (int i = 0; i < 100; ++i) EXPECT_EQ(stamps.follow(at(0.05 * i)), at(0.05 * i));
  EXPECT_EQ(stamps.follow(at(4.8)), at(4.8)) << "overtaken";
  EXPECT_EQ(stamps.follow(at(4.85)), at(4.85)) << "likewise";
  EXPECT_EQ(stamps.follow(at(5.0)), at(5.0));
  EXPECT_EQ(stamps.set_back(), 0);
}

TEST(RisingStamps, GoOnWhenTheClockWasSetBack) {
  for (const double back : {0.5, 3.0, 1e6}) {
    RisingStamps stamps;
    for (int i = 0; i < 200; ++i) {
      const double true_time = 0.05 * i;
      const Time given = stamps.follow(at(i < 100 ? true_time : true_time - back));
      if (i < 100 || i >= 102) {
        EXPECT_NEAR(to_seconds(given - at(true_time)), 0.0, 1e-6) << i;
      }
    }
    EXPECT_EQ(stamps.set_back(), 1);
  }
}

TEST(LogOdometry, ARealJumpIsOneAndIsSaid) {
  LogOdometry odometry;
  for (int i = 0; i < 100; ++i) {
    const double x = 0.02 * i;
    const auto found = odometry.follow(at(0.05 * i), {i < 60 ? x + 5.0 : x - 1.2, 0.0, {}});
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->x, x + 5.0, 1e-9);
  }
  EXPECT_EQ(odometry.note(), "the odometry jumped once, 3 s after it began: such a step is taken for no motion");
}

TEST(LogOdometry, AScanThatIsLateKeepsThePoseOfItsMoment) {
  LogOdometry odometry;
  for (int i = 0; i < 100; ++i) {
    const double x = 0.02 * i;
    EXPECT_TRUE(odometry.follow(at(0.05 * i), {x, 0.0, {}}));
    EXPECT_FALSE(odometry.follow(at(0.05 * i - 0.01), {x - 0.004, 0.0, {}}));
    EXPECT_NEAR(odometry.follow_scan(at(0.05 * i - 0.02), {x - 0.008, 0.0, {}}).x, x - 0.008, 1e-9);
  }
  EXPECT_EQ(odometry.note(), "");
}

TEST(LogOdometry, InventedTimesTellNothingOfSpeeds) {
  LogOdometry odometry{false};
  EXPECT_TRUE(odometry.follow(at(0.0), {2.0, 0.0, {}}));
  EXPECT_NEAR(odometry.follow(at(0.2), {7.0, 0.0, {}})->x, 7.0, 1e-9) << "the file's steps may be long";
  EXPECT_NEAR(odometry.follow(at(0.4), {})->x, 7.0, 6.0);
  EXPECT_NE(odometry.note(), "") << "zero to the last digit is none";
}

TEST(OdometryAt, GoesOnForAStepAndStandsThen) {
  LaserLog log;
  EXPECT_EQ(odometry_at(log, at(1.0)).x, 0.0);
  log.odometry.push_back({at(1.0), {2.0, 0.0, {}}, 0.0, 0.0});
  EXPECT_EQ(odometry_at(log, at(3.0)).x, 2.0) << "of one reading no motion is known";
  log.odometry.push_back({at(1.1), {2.05, 0.0, Angle::radians(0.1)}, 0.0, 0.0});
  EXPECT_NEAR(odometry_at(log, at(1.05)).x, 2.025, 1e-9);
  EXPECT_NEAR(odometry_at(log, at(1.16)).x, 2.08, 1e-9) << "a scan of a torn file comes after the last odometry";
  EXPECT_NEAR(odometry_at(log, at(1.16)).theta.radians(), 0.16, 1e-9);
  EXPECT_NEAR(odometry_at(log, at(5.0)).x, 2.1, 1e-9);
  EXPECT_NEAR(odometry_at(log, at(0.96)).x, 1.98, 1e-9);
  EXPECT_NEAR(odometry_at(log, at(-5.0)).x, 1.95, 1e-9);
  log.odometry.push_back({at(4.1), {5.05, 0.0, Angle::radians(0.1)}, 0.0, 0.0});
  EXPECT_NEAR(odometry_at(log, at(9.0)).x, 5.25, 1e-9) << "of readings that are far apart 0.2 s at most";
}

}  // namespace
}  // namespace docent::recording::log_odometry_test
