#include "docent/mapping/pose_graph/pose_graph.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "docent/mapping/pose_graph/marginal_covariance.h"
#include "docent/mapping/pose_graph/relative_covariance.h"

namespace docent::mapping {
namespace {

Eigen::Matrix3d information(double metres, double radians) {
  const Eigen::Vector3d inverse_squares{1.0 / (metres * metres), 1.0 / (metres * metres), 1.0 / (radians * radians)};
  return inverse_squares.asDiagonal();
}

/// A square of 40 steps of 1 m, turning left at the corners; every step turns a degree too far.
PoseGraph square_that_veers() {
  PoseGraph graph;
  graph.add_pose({});
  for (std::size_t i = 1; i <= 40; ++i) {
    const double turn = (i % 10 == 0 ? 90.0 : 0.0) + 1.0;
    const Pose2 step{1.0, 0.0, Angle::degrees(turn)};
    graph.add_pose(graph.poses().back() * step);
    graph.add({i - 1, i, step, information(0.05, 0.03), false});
  }
  return graph;
}

TEST(PoseGraph, ALoopTakesTheDriftOutOfTheWholeWay) {
  PoseGraph graph = square_that_veers();
  EXPECT_GT(norm(graph.poses().back().position()), 3.0);
  graph.add({0, 40, {0.0, 0.0, {}}, information(0.02, 0.01), true});
  graph.optimise({});
  EXPECT_LT(norm(graph.poses().back().position()), 0.1);
  EXPECT_NEAR(graph.poses()[20].x, 10.0, 0.5);
  EXPECT_NEAR(graph.poses()[20].y, 10.0, 0.5);
  EXPECT_EQ(graph.poses().front().x, 0.0);
}

TEST(PoseGraph, AWrongLoopIsOutvotedAndTakenAway) {
  PoseGraph graph = square_that_veers();
  for (const std::size_t i : {38U, 39U, 40U}) {  // the last leg comes down the y axis
    const Pose2 truly{0.0, 40.0 - static_cast<double>(i), Angle::degrees(i == 40 ? 0 : -90)};
    graph.add({0, i, truly, information(0.02, 0.01), true});
  }
  const PoseConstraint wrong{5, 25, {0.0, 0.0, {}}, information(0.02, 0.01), true};
  graph.add(wrong);
  graph.optimise({});
  EXPECT_GT(graph.error_of(wrong), 50.0);
  EXPECT_EQ(graph.remove_wrong_loops({}), 1U);
  graph.optimise({});
  EXPECT_LT(norm(graph.poses().back().position()), 0.1);
  EXPECT_NEAR(graph.poses()[25].y, 10.0, 0.5);
}

TEST(PoseGraph, OdometryThatHasProvedToBeGoodYieldsLess) {
  const auto end_with_scale = [](double scale) {
    PoseGraph graph;
    for (int i = 0; i < 3; ++i) graph.add_pose({static_cast<double>(i), 0.0, {}});
    graph.add({0, 1, {1.0, 0.0, {}}, information(0.1, 0.1), false, true});
    graph.add({1, 2, {1.0, 0.0, {}}, information(0.1, 0.1), false, false});
    graph.add({0, 2, {2.2, 0.0, {}}, information(0.001, 0.001), false});
    graph.optimise({}, scale);
    return graph.poses()[1].x;
  };
  EXPECT_NEAR(end_with_scale(1.0), 1.1, 0.001);
  EXPECT_NEAR(end_with_scale(0.1), 1.0 + 0.2 * 0.01 / 1.01, 0.001);  // in proportion to squared sigmas
}

TEST(PoseGraph, AnErrorIsCountedInSigmas) {
  PoseGraph graph;
  graph.add_pose({});
  graph.add_pose({1.1, 0.0, {}});
  EXPECT_NEAR(graph.error_of({0, 1, {1.0, 0.0, {}}, information(0.05, 0.03), false}), 2.0, 1e-9);
}

TEST(CovariancesSeenFrom, GrowAlongTheWayAndShrinkWithALoop) {
  PoseGraph graph = square_that_veers();
  const auto open = covariances_seen_from(graph, 0);
  EXPECT_EQ(open[0].trace(), 0.0);
  EXPECT_LT(open[5].trace(), open[20].trace());
  EXPECT_LT(open[20].trace(), open[40].trace() + 1.0);
  graph.add({0, 40, {0.0, 0.0, {}}, information(0.02, 0.01), true});
  const auto closed = covariances_seen_from(graph, 0);
  EXPECT_LT(closed[40].trace(), 0.01);
  EXPECT_LT(closed[35].trace(), open[35].trace());
}

/// A straight way: its end is known as a drawn one scatters.
TEST(CovariancesSeenFrom, AreThoseOfAStraightWay) {
  PoseGraph graph;
  graph.add_pose({});
  for (std::size_t i = 1; i <= 10; ++i) {
    graph.add_pose({static_cast<double>(i), 0.0, {}});
    graph.add({i - 1, i, {1.0, 0.0, {}}, information(0.1, 0.02), false});
  }
  const Eigen::Matrix3d end = covariances_seen_from(graph, 0)[10];
  EXPECT_NEAR(end(0, 0), 10 * 0.01, 1e-6);
  EXPECT_NEAR(end(2, 2), 10 * 0.0004, 1e-6);
  double sideways = 10 * 0.01;
  for (int i = 0; i < 10; ++i) sideways += i * i * 0.0004;
  EXPECT_NEAR(end(1, 1), sideways, 1e-6);
}

TEST(MarginalCovariances, OfOneChainAreThoseOfTheChain) {
  PoseGraph graph = square_that_veers();
  const MarginalCovariances marginal{graph};
  for (const std::size_t from : {0U, 3U, 17U}) {
    const auto chain = covariances_seen_from(graph, from);
    for (const std::size_t to : {18U, 25U, 40U})
      EXPECT_TRUE(marginal.between(from, to).isApprox(chain[to], 0.02)) << from << " to " << to;
  }
}

TEST(MarginalCovariances, TwoWaysTellMoreThanOne) {
  PoseGraph graph;
  for (int i = 0; i < 3; ++i) graph.add_pose({static_cast<double>(i), 0.0, {}});
  for (int times = 0; times < 4; ++times) {
    graph.add({0, 1, {1.0, 0.0, {}}, information(0.1, 0.02), false});
    graph.add({1, 2, {1.0, 0.0, {}}, information(0.1, 0.02), false});
  }
  EXPECT_NEAR(MarginalCovariances{graph}.between(0, 1)(0, 0), 0.01 / 4.0, 1e-6);
  EXPECT_NEAR(MarginalCovariances{graph}.between(0, 2)(0, 0), 0.02 / 4.0, 1e-6);
  EXPECT_NEAR(covariances_seen_from(graph, 0)[2](0, 0), 0.02, 1e-6) << "one chain alone";
}

}  // namespace
}  // namespace docent::mapping
