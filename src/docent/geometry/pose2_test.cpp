#include "docent/geometry/pose2.h"

#include <gtest/gtest.h>

#include "docent/base/random.h"

namespace docent {
namespace {

Pose2 any_pose(Rng& rng) { return {rng.uniform(-50, 50), rng.uniform(-50, 50), Angle::radians(rng.uniform(-4, 4))}; }

TEST(Pose2, InverseUndoesEveryMotion) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Rng rng{seed};
    const Pose2 map_from_robot = any_pose(rng);
    const Pose2 none = inverse(map_from_robot) * map_from_robot;
    EXPECT_NEAR(norm(none.position()), 0.0, 1e-12) << "seed " << seed;
    EXPECT_NEAR(none.theta.radians(), 0.0, 1e-12) << "seed " << seed;
  }
}

TEST(Pose2, CompositionIsAssociativeOnPoints) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Rng rng{seed};
    const Pose2 a = any_pose(rng);
    const Pose2 b = any_pose(rng);
    const Point2 p = any_pose(rng).position();
    EXPECT_NEAR(distance((a * b) * p, a * (b * p)), 0.0, 1e-9) << "seed " << seed;
  }
}

TEST(Angle, IsAlwaysWrapped) {
  EXPECT_DOUBLE_EQ(Angle::degrees(180).degrees(), -180.0);
  EXPECT_DOUBLE_EQ(Angle::degrees(540).degrees(), -180.0);
  EXPECT_NEAR((Angle::degrees(170) + Angle::degrees(20)).degrees(), -170.0, 1e-12);
  EXPECT_NEAR((Angle::degrees(-170) - Angle::degrees(20)).degrees(), 170.0, 1e-12);
}

}  // namespace
}  // namespace docent
