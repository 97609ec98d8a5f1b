#include "docent/motion_models/odometry_model.h"

#include <gtest/gtest.h>

namespace docent::motion_models {
namespace {

TEST(OdometryModel, ErrorDoesNotDependOnHowAMotionIsCut) {
  const OdometryModelParams params;
  const MotionNoise whole = motion_noise(params, {1.0, 0.0, Angle{}});
  MotionNoise parts;
  for (int i = 0; i < 10; ++i) {
    const MotionNoise part = motion_noise(params, {0.1, 0.0, Angle{}});
    parts.position_variance += part.position_variance;
    parts.heading_variance += part.heading_variance;
  }
  EXPECT_NEAR(whole.position_variance, parts.position_variance, 1e-12);
  EXPECT_NEAR(whole.heading_variance, parts.heading_variance, 1e-12);
  EXPECT_NEAR(std::sqrt(whole.position_variance), 0.04, 1e-12);
}

TEST(OdometryModel, StandingStillCostsNothingAndDirectionDoesNotMatter) {
  const OdometryModelParams params;
  EXPECT_EQ(motion_noise(params, {}).position_variance, 0.0);
  EXPECT_EQ(motion_noise(params, {}).heading_variance, 0.0);
  EXPECT_DOUBLE_EQ(motion_noise(params, {0.3, 0.4, Angle::degrees(90)}).heading_variance,
                   motion_noise(params, {-0.5, 0.0, Angle::degrees(-90)}).heading_variance);
}

TEST(OdometryModel, RefusesWhatCannotBe) {
  OdometryModelParams params;
  EXPECT_TRUE(params.validate().has_value());
  params.rotation_per_radian = 0.0;
  EXPECT_EQ(params.validate().error().message, "motion.rotation_per_radian must be > 0");
}

}  // namespace
}  // namespace docent::motion_models
