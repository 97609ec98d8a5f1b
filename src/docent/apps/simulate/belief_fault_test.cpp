#include "docent/apps/simulate/belief_fault.h"

#include <gtest/gtest.h>

#include <numeric>

namespace docent::apps::simulate_command {
namespace {

docent_msgs::Belief belief_at(double x, double y, double theta) {
  docent_msgs::Belief belief;
  belief.hypotheses.push_back({x, y, theta, {}, 0.9});
  for (int i = 0; i < 8192; ++i) {
    const auto mass = i == 0 ? 0.9F : 0.1F / 8191.0F;
    belief.cells.push_back({static_cast<float>(x), static_cast<float>(y), static_cast<float>(theta), mass});
  }
  return belief;
}

TEST(BeliefFault, ThePoseIsOffWhileTheCellsStay) {
  BeliefFault fault;
  fault.strike(simulator::PoseError{0.3, 0.0, 0.17, 5.0}, time_from_seconds(10.0));
  const auto struck = fault.apply(belief_at(1.0, 2.0, 0.5), time_from_seconds(12.0));
  EXPECT_DOUBLE_EQ(struck.hypotheses.front().x, 1.3);
  EXPECT_DOUBLE_EQ(struck.hypotheses.front().theta, 0.67);
  EXPECT_FLOAT_EQ(struck.cells.front().x, 1.0F);
  EXPECT_DOUBLE_EQ(fault.apply(belief_at(1.0, 2.0, 0.5), time_from_seconds(16.0)).hypotheses.front().x, 1.0);
}

TEST(BeliefFault, TheSecondModeIsAsHeavyAndMovesAlong) {
  BeliefFault fault;
  fault.strike(simulator::SecondMode{{10.0, 5.0, Angle::degrees(90)}, 0.0}, time_from_seconds(10.0));
  const auto first = fault.apply(belief_at(1.0, 2.0, 0.0), time_from_seconds(10.5));
  ASSERT_EQ(first.hypotheses.size(), 2U);
  EXPECT_DOUBLE_EQ(first.hypotheses[0].mass, 0.45);
  EXPECT_DOUBLE_EQ(first.hypotheses[1].mass, 0.45);
  EXPECT_NEAR(first.hypotheses[1].x, 10.0, 1e-9);
  EXPECT_NEAR(first.hypotheses[1].theta, 1.5708, 1e-4);
  EXPECT_LE(first.cells.size(), 8192U);
  const double there = std::accumulate(first.cells.begin(), first.cells.end(), 0.0, [](double sum, const auto& cell) {
    return sum + (cell.x > 5.0F ? cell.mass : 0.0F);
  });
  EXPECT_NEAR(there, 0.47, 0.02);
  const auto then = fault.apply(belief_at(2.0, 2.0, 0.0), time_from_seconds(12.0));  // a metre ahead
  EXPECT_NEAR(then.hypotheses[1].x, 10.0, 1e-6);
  EXPECT_NEAR(then.hypotheses[1].y, 6.0, 1e-6);
}

}  // namespace
}  // namespace docent::apps::simulate_command
