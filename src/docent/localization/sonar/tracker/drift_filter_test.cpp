#include "docent/localization/sonar/tracker/drift_filter.h"

#include <gtest/gtest.h>

#include <cmath>

#include "docent/base/random.h"

namespace docent::localization::drift_filter_test {
namespace {

constexpr motion_models::OdometryModelParams kNoise{4e-4, 1e-4, 2e-4, 1e-3, 0.0};

PoseMatrix diagonal(double position, double heading) {
  return {position * position, 0.0, 0.0, 0.0, position * position, 0.0, 0.0, 0.0, heading * heading};
}

TEST(PoseMatrix, InverseUndoes) {
  const PoseMatrix matrix{4.0, 1.0, 0.5, 1.0, 3.0, -0.2, 0.5, -0.2, 0.1};
  const PoseMatrix other = inverse_of(matrix);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      double sum = 0.0;
      for (std::size_t j = 0; j < 3; ++j) sum += matrix[3 * i + j] * other[3 * j + k];
      EXPECT_NEAR(sum, i == k ? 1.0 : 0.0, 1e-12);
    }
  }
  EXPECT_NEAR(squared_length(matrix, {1.0, 2.0, 0.0}), 4.0 + 4.0 + 12.0, 1e-12);
}

TEST(DriftFilter, FollowsOdometryAndDoubtsMoreWithTheWay) {
  DriftFilter filter{kNoise, {}};
  filter.start_at({1.0, 2.0, Angle::degrees(90.0)}, diagonal(0.01, 0.01));
  double last = 0.0;
  for (int i = 0; i < 100; ++i) {
    filter.move({0.1, 0.0, Angle{}});
    EXPECT_GT(filter.covariance()[0], last);
    last = filter.covariance()[0];
  }
  EXPECT_NEAR(filter.map_from_robot().x, 1.0, 1e-9);
  EXPECT_NEAR(filter.map_from_robot().y, 12.0, 1e-9);
  // Ten metres on, a heading that may be off by some degrees shows sideways (x), not along the way (y).
  EXPECT_GT(filter.covariance()[0], 2.0 * filter.covariance()[4]);
}

/// The covariance is what a cloud of drawn robots spreads to.
TEST(DriftFilter, ItsCovarianceIsThatOfManyDraws) {
  const OdometryDriftParams drift{0.01, 0.02, 0.01};
  DriftFilter filter{kNoise, drift};
  filter.start_at({}, diagonal(0.05, 0.02));
  constexpr int kDraws = 4000;
  constexpr int kSteps = 60;
  const Pose2 step{0.1, 0.0, Angle::degrees(1.0)};
  for (int i = 0; i < kSteps; ++i) filter.move(step);
  Rng rng{11};
  double xx = 0.0;
  double yy = 0.0;
  double tt = 0.0;
  const motion_models::MotionNoise noise = motion_models::motion_noise(kNoise, step);
  for (int draw = 0; draw < kDraws; ++draw) {
    Pose2 pose{rng.normal(0.0, 0.05), rng.normal(0.0, 0.05), Angle::radians(rng.normal(0.0, 0.02))};
    const double scale = rng.normal(0.0, drift.scale);
    const double turning = rng.normal(0.0, drift.turning);
    const double veer = rng.normal(0.0, drift.veer);
    for (int i = 0; i < kSteps; ++i) {
      pose = pose * Pose2{step.x * (1.0 + scale), 0.0,
                          Angle::radians(step.theta.radians() * (1.0 + turning) + veer * step.x +
                                         rng.normal(0.0, std::sqrt(noise.heading_variance)))};
      pose.x += rng.normal(0.0, std::sqrt(noise.position_variance));
      pose.y += rng.normal(0.0, std::sqrt(noise.position_variance));
    }
    const auto off = difference(pose, filter.map_from_robot());
    xx += off[0] * off[0] / kDraws;
    yy += off[1] * off[1] / kDraws;
    tt += off[2] * off[2] / kDraws;
  }
  EXPECT_NEAR(filter.covariance()[0] / xx, 1.0, 0.1);
  EXPECT_NEAR(filter.covariance()[4] / yy, 1.0, 0.1);
  EXPECT_NEAR(filter.covariance()[8] / tt, 1.0, 0.1);
}

TEST(DriftFilter, LearnsWhatOdometryDoesWrongAllDay) {
  constexpr double kScale = 0.008;
  constexpr double kVeer = -0.012;
  constexpr double kTurning = 0.015;
  DriftFilter filter{kNoise, {}};
  filter.start_at({}, diagonal(0.02, 0.01));
  Pose2 truth;
  Rng rng{3};
  for (int i = 0; i < 16000; ++i) {
    // Straight on, and a turn now and then.
    const Pose2 odometry = i % 40 < 34 ? Pose2{0.05, 0.0, Angle{}} : Pose2{0.0, 0.0, Angle::degrees(15.0)};
    truth = truth * Pose2{odometry.x * (1.0 + kScale), 0.0,
                          Angle::radians(odometry.theta.radians() * (1.0 + kTurning) + kVeer * odometry.x)};
    filter.move(odometry);
    if (i % 20 != 19) continue;
    // A match of 3 cm and a wall of a degree.
    const PoseMatrix information = inverse_of(filter.covariance());
    PoseMatrix sum = information;
    for (const std::size_t k : {0U, 4U}) sum[k] += 1.0 / (0.03 * 0.03);
    const PoseMatrix posterior = inverse_of(sum);
    const Pose2 seen{truth.x + rng.normal(0.0, 0.03), truth.y + rng.normal(0.0, 0.03), truth.theta};
    const auto off = difference(seen, filter.map_from_robot());
    std::array<double, 3> by{};
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t k = 0; k < 2; ++k) by[r] += posterior[3 * r + k] * off[k] / (0.03 * 0.03);
    const Pose2 pose = filter.map_from_robot();
    filter.correct_pose({pose.x + by[0], pose.y + by[1], pose.theta + Angle::radians(by[2])}, posterior);
    filter.correct_heading(truth.theta + Angle::radians(rng.normal(0.0, 0.02)), 0.02);
  }
  EXPECT_NEAR(filter.scale(), kScale, 0.003);
  EXPECT_NEAR(filter.veer(), kVeer, 0.003);
  EXPECT_NEAR(filter.turning(), kTurning, 0.006);
  const auto off = difference(filter.map_from_robot(), truth);
  EXPECT_LT(std::hypot(off[0], off[1]), 0.05);
}

TEST(DriftFilter, AHeadingCorrectsThePositionThatItBroughtAbout) {
  DriftFilter filter{kNoise, {}};
  filter.start_at({}, diagonal(0.001, 0.05));
  for (int i = 0; i < 50; ++i) filter.move({0.1, 0.0, Angle{}});
  filter.correct_heading(Angle::radians(0.05), 0.002);
  EXPECT_NEAR(filter.map_from_robot().theta.radians(), 0.05, 0.01);
  EXPECT_GT(filter.map_from_robot().y, 0.1) << "five metres at up to 0.05 rad";
}

TEST(DriftFilter, RefusesWildParameters) {
  EXPECT_TRUE(OdometryDriftParams{}.validate());
  EXPECT_FALSE((OdometryDriftParams{0.0, 0.02, 0.02}.validate()));
  EXPECT_FALSE((OdometryDriftParams{0.01, 0.02, std::nan("")}.validate()));
}

}  // namespace
}  // namespace docent::localization::drift_filter_test
