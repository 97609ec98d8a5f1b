#include "docent/planning/survey/normal_pose.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace docent::planning::normal_pose_test {
namespace {

TEST(NormalPose, ItsCellsHaveItsMeanItsSpreadAndAllOfItsMass) {
  const NormalPose pose{{3.0, -2.0, Angle::radians(0.5)}, 0.06, 0.02};
  const auto belief = belief_of(pose);
  double mass = 0.0, x = 0.0, y = 0.0, heading = 0.0, variance = 0.0;
  for (const auto& cell : belief.cells) {
    const auto m = static_cast<double>(cell.mass);
    mass += m;
    x += m * static_cast<double>(cell.x);
    y += m * static_cast<double>(cell.y);
    heading += m * static_cast<double>(cell.theta);
    variance += m * (static_cast<double>(cell.x) - 3.0) * (static_cast<double>(cell.x) - 3.0);
  }
  EXPECT_NEAR(mass, 1.0, 1e-5);
  EXPECT_NEAR(x, 3.0, 1e-4);
  EXPECT_NEAR(y, -2.0, 1e-4);
  EXPECT_NEAR(heading, 0.5, 1e-4);
  EXPECT_NEAR(std::sqrt(variance), 0.06, 0.006) << "two deviations to both sides hold most of it";
  const auto likeliest = std::max_element(belief.cells.begin(), belief.cells.end(),
                                          [](const auto& a, const auto& b) { return a.mass < b.mass; });
  EXPECT_FLOAT_EQ(likeliest->x, 3.0F);
}

TEST(NormalPose, ItIsOneMode) {
  const auto belief = belief_of({{3.0, -2.0, Angle::radians(0.5)}, 0.06, 0.02});
  ASSERT_EQ(belief.modes.size(), 1U);
  EXPECT_EQ(belief.modes[0].mass, 1.0);
  EXPECT_EQ(belief.modes[0].map_from_robot.y, -2.0);
  EXPECT_NEAR(belief.modes[0].covariance[0], 0.0036, 1e-12);
  EXPECT_NEAR(belief.modes[0].covariance[4], 0.0036, 1e-12);
  EXPECT_NEAR(belief.modes[0].covariance[8], 0.0004, 1e-12);
  EXPECT_EQ(belief.modes[0].covariance[1], 0.0);
}

}  // namespace
}  // namespace docent::planning::normal_pose_test
