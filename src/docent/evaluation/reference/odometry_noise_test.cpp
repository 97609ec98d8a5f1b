#include "docent/evaluation/reference/odometry_noise.h"

#include <gtest/gtest.h>

#include <cmath>

namespace docent::evaluation {
namespace {

std::vector<Pose2> straight(std::size_t steps, double step) {
  std::vector<Pose2> way;
  for (std::size_t i = 0; i <= steps; ++i) way.push_back({static_cast<double>(i) * step, 0.0, Angle{}});
  return way;
}

TEST(OdometryNoise, WithoutErrorsIsTheWayItself) {
  std::vector<Pose2> way;
  for (int i = 0; i < 50; ++i) way.push_back({0.3 * i, std::sin(0.2 * i), Angle::radians(0.4 * i)});
  const auto odometry = noisy_odometry(way, {0, 0, 0, 0, 0}, Rng{1});
  ASSERT_EQ(odometry.size(), way.size());
  for (std::size_t i = 0; i < way.size(); ++i) {
    EXPECT_NEAR(distance(odometry[i].position(), way[i].position()), 0.0, 1e-9);
    EXPECT_NEAR((odometry[i].theta - way[i].theta).radians(), 0.0, 1e-9);
  }
}

TEST(OdometryNoise, ErrsAsSaid) {
  const auto way = straight(4000, 2.0);
  const auto odometry = noisy_odometry(way, {0.1, 0.1, 0.03, 0.0, 0.0}, Rng{7});
  double ways = 0.0;
  double turns = 0.0;
  for (std::size_t i = 1; i < odometry.size(); ++i) {
    const Pose2 step = inverse(odometry[i - 1]) * odometry[i];
    ways += std::pow(norm(step.position()) - 2.0, 2);
    turns += std::pow(step.theta.radians(), 2);
  }
  EXPECT_NEAR(std::sqrt(ways / 4000.0), 0.2, 0.01);
  EXPECT_NEAR(std::sqrt(turns / 4000.0), 0.06, 0.003);
}

TEST(OdometryNoise, OneScaleAndOneVeerARunAndASeedIsARun) {
  const auto way = straight(100, 1.0);
  const OdometryNoiseParams systematic{0.0, 0.0, 0.0, 0.02, 0.01};
  const auto odometry = noisy_odometry(way, systematic, Rng{3});
  const Pose2 first = inverse(odometry[0]) * odometry[1];
  const Pose2 last = inverse(odometry[99]) * odometry[100];
  EXPECT_NEAR(norm(first.position()), norm(last.position()), 1e-9);
  EXPECT_NEAR(first.theta.radians(), last.theta.radians(), 1e-9);
  EXPECT_NE(first.theta.radians(), 0.0);
  EXPECT_EQ(noisy_odometry(way, systematic, Rng{3}).back().y, odometry.back().y);
  EXPECT_NE(noisy_odometry(way, systematic, Rng{4}).back().y, odometry.back().y);
  EXPECT_TRUE(noisy_odometry({}, systematic, Rng{3}).empty());
  EXPECT_FALSE((OdometryNoiseParams{-0.1, 0, 0, 0, 0}.validate()));
}

}  // namespace
}  // namespace docent::evaluation
