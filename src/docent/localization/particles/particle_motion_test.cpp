#include "docent/localization/particles/particle_motion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "docent/localization/monte_carlo/testing.h"

namespace docent::localization {
namespace {

constexpr MapBox kEverywhere{-100.0F, -100.0F, 100.0F, 100.0F};

TEST(NoiseStreams, DrawsAreNormalIndependentAndRepeatable) {
  NoiseStreams streams{5};
  std::vector<float> a(160000);
  std::vector<float> b(160000);
  streams.fill_normal(a);
  streams.fill_normal(b);
  double mean = 0.0, square = 0.0, product = 0.0, fourth = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const auto x = static_cast<double>(a[i]);
    mean += x, square += x * x, fourth += x * x * x * x, product += x * static_cast<double>(b[i]);
  }
  const auto n = static_cast<double>(a.size());
  EXPECT_NEAR(mean / n, 0.0, 0.01);
  EXPECT_NEAR(square / n, 1.0, 0.015);
  EXPECT_NEAR(fourth / n, 2.7, 0.06);  // 3 - 6 / (5 * 4): four uniform draws
  EXPECT_NEAR(product / n, 0.0, 0.01);
  NoiseStreams again{5};
  std::vector<float> c(160000);
  again.fill_normal(c);
  EXPECT_EQ(a, c);
  EXPECT_NE(a, b);
}

TEST(NoiseStreams, LanesDifferAndUniformDrawsFillTheirInterval) {
  NoiseStreams streams{6};
  std::vector<float> u(16000);
  streams.fill_uniform(u);
  std::vector<int> counts(10, 0);
  for (const float value : u) {
    ASSERT_GE(value, 0.0F);
    ASSERT_LT(value, 1.0F);
    ++counts[static_cast<std::size_t>(value * 10.0F)];
  }
  for (const int count : counts) EXPECT_NEAR(count, 1600, 200);
  for (std::size_t lane = 1; lane < NoiseStreams::kLanes; ++lane) EXPECT_NE(u[0], u[lane]);
}

TEST(ParticleMotion, WithoutErrorsItIsTheIncrement) {
  Rng rng{1};
  ParticleSet particles = testing::any_particles(rng, 100, 6.0, 4.0);
  const ParticleSet before = particles;
  motion_models::OdometryModelParams params{1e-12, 0.0, 0.0, 1e-12, 0.0};
  const Pose2 step{0.3, -0.1, Angle::degrees(20.0)};
  NoiseStreams noise{1};
  move_particles(particles, params, step, {0.0, 0.0}, kEverywhere, noise);
  for (std::size_t i = 0; i < 100; ++i) {
    const Pose2 expected = before.pose(i) * step;
    EXPECT_NEAR(particles.pose(i).x, expected.x, 1e-4);
    EXPECT_NEAR(particles.pose(i).y, expected.y, 1e-4);
    EXPECT_NEAR((particles.pose(i).theta - expected.theta).degrees(), 0.0, 0.01);
  }
}

TEST(ParticleMotion, SpreadsAsTheModelSays) {
  ParticleSet particles;
  particles.resize(50000);
  for (std::size_t i = 0; i < particles.size(); ++i) particles.set(i, {2.0, 1.0, Angle::degrees(30.0)}, 1.0F);
  motion_models::OdometryModelParams params;
  params.slip_probability = 0.0;
  const Pose2 step{0.5, 0.0, Angle::degrees(15.0)};
  const motion_models::MotionNoise error = motion_models::motion_noise(params, step);
  NoiseStreams noise{2};
  move_particles(particles, params, step, {0.0, 0.0}, kEverywhere, noise);
  const Pose2 mean = Pose2{2.0, 1.0, Angle::degrees(30.0)} * step;
  double x = 0.0, xx = 0.0, tt = 0.0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const Pose2 pose = particles.pose(i);
    x += pose.x - mean.x;
    xx += (pose.x - mean.x) * (pose.x - mean.x);
    tt += std::pow((pose.theta - mean.theta).radians(), 2.0);
  }
  const auto n = static_cast<double>(particles.size());
  EXPECT_NEAR(x / n, 0.0, 0.001);
  EXPECT_NEAR(xx / n, error.position_variance, 0.03 * error.position_variance);
  EXPECT_NEAR(tt / n, error.heading_variance, 0.03 * error.heading_variance);
}

TEST(ParticleMotion, SlipsWithTheirProbabilityAndOnlyWhenMoving) {
  const auto far_turned = [](const Pose2& step) {
    ParticleSet particles;
    particles.resize(20000);
    for (std::size_t i = 0; i < particles.size(); ++i) particles.set(i, {}, 1.0F);
    motion_models::OdometryModelParams params;
    params.slip_probability = 0.1;
    NoiseStreams noise{3};
    move_particles(particles, params, step, {0.0, 0.0}, kEverywhere, noise);
    int count = 0;
    for (std::size_t i = 0; i < particles.size(); ++i) count += std::abs(particles.pose(i).theta.degrees()) > 5.0;
    return static_cast<double>(count) / 20000.0;
  };
  EXPECT_NEAR(far_turned({0.25, 0.0, Angle{}}), 0.1 * 0.55, 0.02);
  EXPECT_EQ(far_turned({}), 0.0);
}

TEST(ParticleMotion, StaysInTheBoxAndHeadingsKeepTheirLength) {
  Rng rng{7};
  ParticleSet particles = testing::any_particles(rng, 333, 6.0, 4.0);
  const MapBox box{0.0F, 0.0F, 6.0F, 4.0F};
  NoiseStreams noise{4};
  for (int i = 0; i < 500; ++i)
    move_particles(particles, {}, {0.2, 0.0, Angle::degrees(17.0)}, {0.01, 0.2}, box, noise);
  for (std::size_t i = 0; i < particles.padded_size(); ++i) {
    ASSERT_GE(particles.x[i], box.left);
    ASSERT_LE(particles.x[i], box.right);
    ASSERT_GE(particles.y[i], box.bottom);
    ASSERT_LE(particles.y[i], box.top);
    ASSERT_NEAR(std::hypot(particles.heading_x[i], particles.heading_y[i]), 1.0, 1e-5);
  }
}

}  // namespace
}  // namespace docent::localization
