#include "docent/mapping/scan_matching/line_matcher.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

namespace docent::mapping {
namespace {

/// Points each 5 cm on the walls of a room of `length` x 3 m, seen from its middle; without end walls a corridor.
std::vector<SurfacePoint> room(double length, bool has_ends) {
  std::vector<SurfacePoint> points;
  for (double x = -0.5 * length; x <= 0.5 * length; x += 0.05) {
    points.push_back({{x, 1.5}, {0.0, -1.0}});
    points.push_back({{x, -1.5}, {0.0, 1.0}});
  }
  for (double y = -1.5; has_ends && y <= 1.5; y += 0.05) {
    points.push_back({{0.5 * length, y}, {-1.0, 0.0}});
    points.push_back({{-0.5 * length, y}, {1.0, 0.0}});
  }
  return points;
}

std::vector<SurfacePoint> seen_from(const Pose2& pose, const std::vector<SurfacePoint>& points) {
  std::vector<SurfacePoint> seen;
  for (const SurfacePoint& point : points) seen.push_back(transformed(inverse(pose), point));
  return seen;
}

TEST(LineMatch, FindsThePoseToAMillimetre) {
  const SurfaceIndex reference{room(5.0, true)};
  const Pose2 truth{0.15, -0.12, Angle::degrees(4)};
  const auto match = line_match(reference, seen_from(truth, room(5.0, true)), {}, {});
  ASSERT_TRUE(match);
  EXPECT_LT(distance(match->reference_from_sweep.position(), truth.position()), 0.001);
  EXPECT_LT(std::abs((match->reference_from_sweep.theta - truth.theta).degrees()), 0.05);
  EXPECT_GT(match->overlap, 0.95);
  EXPECT_LT(match->residual, 0.005);
}

TEST(LineMatch, LeavesThePlaceAlongACorridorAndSaysThatItIsNotKnown) {
  const SurfaceIndex reference{room(12.0, false)};
  const Pose2 truth{0.20, -0.10, Angle::degrees(3)};
  const auto match = line_match(reference, seen_from(truth, room(8.0, false)), {}, {});
  ASSERT_TRUE(match);
  EXPECT_NEAR(match->reference_from_sweep.y, truth.y, 0.005);
  EXPECT_NEAR(match->reference_from_sweep.theta.degrees(), truth.theta.degrees(), 0.1);
  EXPECT_LT(std::abs(match->reference_from_sweep.x), 0.05) << "nothing says where along the corridor";
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver{match->information};
  EXPECT_LT(solver.eigenvalues()[0], 1e-3 * solver.eigenvalues()[1]);
}

TEST(LineMatch, PassesOverWhatIsNotInTheReference) {
  const SurfaceIndex reference{room(5.0, true)};
  const Pose2 truth{0.10, 0.08, Angle::degrees(-3)};
  std::vector<SurfacePoint> sweep = seen_from(truth, room(5.0, true));
  for (int i = 0; i < 40; ++i) sweep.push_back({{0.3 + 0.01 * i, 0.4}, {}});  // a person
  const auto match = line_match(reference, sweep, {}, {});
  ASSERT_TRUE(match);
  EXPECT_LT(distance(match->reference_from_sweep.position(), truth.position()), 0.005);
  EXPECT_LT(match->overlap, 0.95);
}

TEST(LineMatch, SaysNothingWhereTooFewPointsMeetALine) {
  const SurfaceIndex reference{room(5.0, true)};
  EXPECT_FALSE(line_match(reference, room(5.0, true), {30.0, 0.0, {}}, {}));
}

TEST(SurfaceIndex, FindsTheNearestWithinReachOnly) {
  const std::vector<SurfacePoint> points{{{0.0, 0.0}, {}}, {{1.0, 0.0}, {}}};
  const SurfaceIndex index{points};
  ASSERT_NE(index.nearest({0.9, 0.1}), nullptr);
  EXPECT_EQ(index.nearest({0.9, 0.1})->at.x, 1.0);
  EXPECT_EQ(index.nearest({0.5, 0.0}), nullptr);
  EXPECT_EQ(index.nearest({50.0, 0.0}), nullptr);
}

}  // namespace
}  // namespace docent::mapping
