#include "docent/planning/coastal/uncertainty.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "docent/base/random.h"

namespace docent::planning {
namespace {

TEST(Uncertainty, GrowsWithTheWayInTheDark) {
  const Uncertainty uncertainty{{}};
  double variance = 1e-4;
  double before = variance;
  for (int metre = 1; metre <= 10; ++metre) {
    variance = uncertainty.after(variance, {}, 1.0);
    EXPECT_GT(variance, before);
    before = variance;
  }
  // Odometry alone: after 10 m the covariance of a random walk of the heading along a line has det^(1/3) of this size.
  EXPECT_GT(std::sqrt(variance), 0.1);
  EXPECT_LT(std::sqrt(variance), 0.6);
}

TEST(Uncertainty, IsMonotoneInWhatWasKnownAndInWhatIsTold) {
  const Uncertainty uncertainty{{}};
  Rng rng{5};
  for (int trial = 0; trial < 1000; ++trial) {
    const double variance = std::exp(rng.uniform(-10.0, 2.0));
    const double way = rng.uniform(0.05, 2.0);
    std::array<double, 3> eigenvalues{};
    for (double& eigenvalue : eigenvalues) eigenvalue = std::exp(rng.uniform(-3.0, 9.0));
    const double after = uncertainty.after(variance, eigenvalues, way);
    EXPECT_GT(uncertainty.after(1.1 * variance, eigenvalues, way), after);
    const auto which = static_cast<std::size_t>(rng.integer(0, 2));
    auto more = eigenvalues;
    more[which] *= 1.2;
    EXPECT_LT(uncertainty.after(variance, more, way), after);
  }
}

TEST(Uncertainty, TellsWhatTheInformationBoundSays) {
  // Without motion noise worth the name: (1/s + n l)^-1 on every axis.
  UncertaintyParams params;
  params.motion.translation_per_metre = 1e-12;
  params.motion.rotation_per_metre = 0.0;
  params.heading_scale = 1e-9;
  const Uncertainty uncertainty{params};
  constexpr double kLambda = 300.0;
  EXPECT_NEAR(uncertainty.after(0.04, {kLambda, kLambda, kLambda}, 0.5), 1.0 / (1.0 / 0.04 + 2.0 * kLambda), 1e-6);
}

TEST(Uncertainty, EntropyIsThatOfTheGaussian) {
  const Uncertainty uncertainty{{}};
  const double k = uncertainty.heading_scale();
  const std::array<double, 9> covariance{0.02, 0.01, 0, 0.01, 0.03, 0, 0, 0, 0.001};
  const double determinant = (0.02 * 0.03 - 0.01 * 0.01) * 0.001;
  const double variance = uncertainty.variance_of(covariance);
  EXPECT_NEAR(k * k * variance * variance * variance, determinant, 1e-12);
  const double wanted = 0.5 * std::log(std::pow(2.0 * std::numbers::pi * std::numbers::e, 3.0) * determinant);
  EXPECT_NEAR(uncertainty.entropy(variance), wanted, 1e-9);
}

}  // namespace
}  // namespace docent::planning
