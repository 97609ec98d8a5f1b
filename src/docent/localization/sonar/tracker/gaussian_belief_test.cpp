#include "docent/localization/sonar/tracker/gaussian_belief.h"

#include <gtest/gtest.h>

#include <cmath>

#include "docent/localization/sonar/tracker/testing.h"

namespace docent::localization::gaussian_belief_test {
namespace {

TEST(GaussianBelief, HasTheGaussiansMomentsAndAllTheMass) {
  const testing::TurnedRoom room{0.0};
  const Pose2 mean{0.4, -0.3, Angle::degrees(179.0)};
  const PoseMatrix covariance{0.04, 0.01, 0.002, 0.01, 0.02, -0.001, 0.002, -0.001, 0.01};
  const BeliefSummary belief = gaussian_belief(mean, covariance, 0.1, room.map);
  double mass = 0.0;
  PoseMatrix moments{};
  for (const auto& cell : belief.cells) {
    const Pose2 pose{static_cast<double>(cell.x), static_cast<double>(cell.y),
                     Angle::radians(static_cast<double>(cell.theta))};
    const auto off = difference(pose, mean);
    mass += static_cast<double>(cell.mass);
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k) moments[3 * i + k] += static_cast<double>(cell.mass) * off[i] * off[k] / 0.9;
  }
  EXPECT_NEAR(mass, 0.9, 1e-4);
  for (std::size_t i = 0; i < 9; ++i) EXPECT_NEAR(moments[i], covariance[i], 0.03 * 0.04) << i;
  double rest = 0.0;
  for (const float value : belief.rest) rest += static_cast<double>(value);
  EXPECT_NEAR(rest, 0.1, 1e-4);
  ASSERT_EQ(belief.modes.size(), 1U);
  EXPECT_EQ(belief.modes[0].mass, 0.9);
}

TEST(GaussianBelief, TheRestLiesOnTheFloorAlone) {
  const testing::TurnedRoom room{0.0};
  const BeliefSummary belief = gaussian_belief({}, {0.01, 0, 0, 0, 0.01, 0, 0, 0, 0.01}, 1.0, room.map);
  for (int row = 0; row < belief.rest_rows; ++row) {
    for (int column = 0; column < belief.rest_columns; ++column) {
      const double x = belief.rest_origin.x + (column + 0.5) * belief.rest_cell_size;
      const float mass = belief.rest[static_cast<std::size_t>(row * belief.rest_columns + column)];
      if (std::abs(x - 0.3) > 5.0) {
        EXPECT_EQ(mass, 0.0F);
      }
    }
  }
}

}  // namespace
}  // namespace docent::localization::gaussian_belief_test
