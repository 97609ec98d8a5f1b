#include "docent/mapping/mount_calibration/mount_fit.h"

#include <gtest/gtest.h>

#include <utility>

#include "docent/base/random.h"

namespace docent::mapping::mount_fit_test {
namespace {

/// Pairs as a sensor with this mount would see them, without noise.
std::vector<MotionPair> pairs_of(const Pose2& mount, std::size_t count, Rng& rng) {
  std::vector<MotionPair> pairs;
  for (std::size_t i = 0; i < count; ++i) {
    const double turn = i % 3 == 0 ? rng.uniform(-0.5, 0.5) : 0.0;
    const Pose2 base{rng.uniform(0.2, 0.6), 0.0, Angle::radians(turn)};
    pairs.push_back({inverse(mount) * base * mount, 1e5 * Eigen::Matrix3d::Identity(), ShiftedMotion::constant(base)});
  }
  return pairs;
}

TEST(MountFit, FindsTheMountOfPairsWithoutNoise) {
  Rng rng{3};
  for (int i = 0; i < 10; ++i) {
    const Pose2 mount{rng.uniform(-0.3, 0.3), rng.uniform(-0.3, 0.3), Angle::radians(rng.uniform(-3.0, 3.0))};
    const auto estimate = fit_mount(pairs_of(mount, 40, rng), vague_prior({}, {}), {});
    EXPECT_NEAR(estimate.state.base_from_sensor.x, mount.x, 0.01);
    EXPECT_NEAR(estimate.state.base_from_sensor.y, mount.y, 0.01);
    EXPECT_NEAR((estimate.state.base_from_sensor.theta - mount.theta).radians(), 0.0, 0.005);
    EXPECT_LT(estimate.misfit, 0.5);
  }
}

TEST(MountFit, IsNotMovedByAThirdOfNonsense) {
  Rng rng{5};
  const Pose2 mount{0.1, -0.05, Angle::degrees(4.0)};
  auto pairs = pairs_of(mount, 60, rng);
  for (std::size_t i = 0; i < pairs.size(); i += 3) pairs[i].sensor_then_from_now.y += 0.3;
  const auto estimate = fit_mount(pairs, vague_prior({}, {}), {});
  EXPECT_NEAR((estimate.state.base_from_sensor.theta - mount.theta).degrees(), 0.0, 1.0);
}

TEST(MountFit, StraightWaysSayNothingOfThePlace) {
  std::vector<MotionPair> pairs;
  for (int i = 0; i < 30; ++i)
    pairs.push_back({{0.5, 0.0, {}}, 1e5 * Eigen::Matrix3d::Identity(), ShiftedMotion::constant({0.5, 0.0, {}})});
  const MountFitParams params;
  const auto estimate = fit_mount(pairs, vague_prior({}, params), params);
  EXPECT_LT(estimate.sigma(kMountHeading), 0.02);
  EXPECT_GT(estimate.sigma_position(), 0.5 * params.position_prior);
}

/// Heading's standard deviation and error [deg], for a way of corridors in each of which all pairs err alike.
std::pair<double, double> of_corridors(double each_off, std::size_t count, Rng& rng) {
  const Pose2 mount{0.2, 0.0, Angle::degrees(3.0)};
  auto pairs = pairs_of(mount, count, rng);
  const int length = MountFitParams{}.piece;
  double off = 0.0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (i % static_cast<std::size_t>(length) == 0) off = each_off * rng.normal();
    Pose2& seen = pairs[i].sensor_then_from_now;
    const Point2 turned = Pose2{0.0, 0.0, Angle::degrees(-off)} * seen.position();
    seen = {turned.x, turned.y, seen.theta};
  }
  const auto estimate = fit_mount(pairs, vague_prior({}, {}), {});
  return {Angle::radians(estimate.sigma(kMountHeading)).degrees(),
          (estimate.state.base_from_sensor.theta - mount.theta).degrees()};
}

/// Mean squared error, in the errors that are told.
double mean_square(double each_off, std::size_t count, Rng& rng) {
  constexpr int kTrials = 40;
  double squares = 0.0;
  for (int i = 0; i < kTrials; ++i) {
    const auto [sigma, error] = of_corridors(each_off, count, rng);
    squares += (error / sigma) * (error / sigma);
  }
  return squares / kTrials;
}

TEST(MountFit, ErrorsAreAsLargeAsPiecesOfTheWayContradictOneAnother) {
  Rng rng{11};
  for (const double each_off : {0.5, 1.0, 2.0}) {
    for (const std::size_t count : {std::size_t{48}, std::size_t{96}, std::size_t{144}}) {
      const double square = mean_square(each_off, count, rng);
      EXPECT_LT(square, 2.0) << "what is told is too small: " << each_off << " degrees, pairs " << count;
      EXPECT_GT(square, 0.1) << "what is told is too large: " << each_off << " degrees, pairs " << count;
    }
  }
  EXPECT_LT(of_corridors(0.0, 96, rng).first, 0.8 * of_corridors(1.0, 96, rng).first);
}

TEST(MountFit, AFewWitnessesOfWhomOneErrsAreNotBelieved) {
  // Two pairs among people agree by chance, and tell of a mount half a metre away; those that come then do not.
  Rng rng{7};
  const Pose2 mount{0.2, 0.0, {}};
  for (std::size_t count = 4; count <= 6; ++count) {
    auto pairs = pairs_of(mount, count, rng);
    for (std::size_t i = 0; i < 2; ++i) {
      const Pose2 nonsense{-0.1, 0.4, Angle::degrees(120.0)};
      const Pose2 base{0.1, 0.0, Angle::radians(0.5)};
      pairs[i] = {inverse(nonsense) * base * nonsense, 1e5 * Eigen::Matrix3d::Identity(),
                  ShiftedMotion::constant(base)};
    }
    const auto estimate = fit_mount(pairs, vague_prior({}, {}), {});
    const double off = distance(estimate.state.base_from_sensor.position(), mount.position());
    EXPECT_LT(off, 3.0 * estimate.sigma_position()) << count << " pairs";
  }
}

TEST(MountFit, OfNoPairsIsThePrior) {
  const MountFitParams params;
  const auto estimate = fit_mount({}, vague_prior({0.2, 0.1, {}}, params), params);
  EXPECT_DOUBLE_EQ(estimate.state.base_from_sensor.x, 0.2);
  EXPECT_NEAR(estimate.sigma(kMountX), params.caution * params.position_prior, 1e-9);
}

}  // namespace
}  // namespace docent::mapping::mount_fit_test
