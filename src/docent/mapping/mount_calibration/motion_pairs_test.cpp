#include "docent/mapping/mount_calibration/motion_pairs.h"

#include <gtest/gtest.h>

namespace docent::mapping::motion_pairs_test {

TEST(ShiftedMotion, IsThatOfEarlierMomentsForLateStamps) {
  motion_models::OdometryHistory odometry{std::chrono::seconds{10}};
  for (int i = 0; i <= 100; ++i) {  // it speeds up: x = t2 / 2
    const double t = 0.05 * i;
    odometry.add(time_from_seconds(t), {0.5 * t * t, 0.0, {}});
  }
  const auto motion = ShiftedMotion::between(odometry, time_from_seconds(2.0), time_from_seconds(3.0));
  ASSERT_TRUE(motion);
  EXPECT_NEAR(motion->at(0.0).x, 2.5, 1e-6);
  EXPECT_NEAR(motion->at(0.2).x, 2.3, 1e-6) << "from 1.8 to 2.8 s";
  EXPECT_NEAR(motion->at(-0.125).x, 2.625, 1e-6);
  EXPECT_NEAR(motion->at(9.0).x, motion->at(ShiftedMotion::kMost).x, 1e-12);
}

TEST(ShiftedMotion, IsNotKnownBeyondTheOdometry) {
  motion_models::OdometryHistory odometry;
  for (int i = 0; i <= 20; ++i) odometry.add(time_from_seconds(0.05 * i), {});
  EXPECT_FALSE(ShiftedMotion::between(odometry, time_from_seconds(0.1), time_from_seconds(0.5)));
  EXPECT_FALSE(ShiftedMotion::between(odometry, time_from_seconds(0.4), time_from_seconds(0.9)));
  EXPECT_TRUE(ShiftedMotion::between(odometry, time_from_seconds(0.4), time_from_seconds(0.6)));
}

}  // namespace docent::mapping::motion_pairs_test
