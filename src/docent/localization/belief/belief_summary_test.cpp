#include "docent/localization/belief/belief_summary.h"

#include <gtest/gtest.h>

namespace docent::localization::belief_summary_test {
namespace {

TEST(CarriedOn, EveryCellAndModeMovesInItsOwnAxes) {
  BeliefSummary belief;
  belief.cells = {{1.0F, 2.0F, 0.0F, 0.7F}, {5.0F, 5.0F, 1.5707964F, 0.3F}};
  belief.modes = {{{1.0, 2.0, {}}, {0.01, 0, 0, 0, 0.02, 0, 0, 0, 0.003}, 0.7}};
  belief.rest = {0.25F};
  const BeliefSummary carried = carried_on(belief, {1.0, 0.0, Angle::degrees(90.0)});
  EXPECT_NEAR(carried.cells[0].x, 2.0F, 1e-6F);
  EXPECT_NEAR(carried.cells[0].y, 2.0F, 1e-6F);
  EXPECT_NEAR(carried.cells[0].theta, 1.5707964F, 1e-6F);
  EXPECT_NEAR(carried.cells[1].x, 5.0F, 1e-6F);
  EXPECT_NEAR(carried.cells[1].y, 6.0F, 1e-6F);
  EXPECT_EQ(carried.cells[1].mass, 0.3F);
  EXPECT_NEAR(carried.modes[0].map_from_robot.x, 2.0, 1e-12);
  EXPECT_NEAR(carried.modes[0].map_from_robot.theta.degrees(), 90.0, 1e-9);
  EXPECT_EQ(carried.modes[0].covariance, belief.modes[0].covariance);
  EXPECT_EQ(carried.modes[0].mass, 0.7);
  EXPECT_EQ(carried.rest, belief.rest);
}

TEST(FindModes, WhatLiesNearTheLikeliestCellIsOneModeWithIt) {
  BeliefSummary belief;
  belief.cells = {{1.0F, 2.0F, 0.0F, 0.4F}, {1.2F, 2.0F, 0.0F, 0.4F}, {5.0F, 5.0F, 0.0F, 0.2F}};
  find_modes(belief, {});
  ASSERT_EQ(belief.modes.size(), 2U);
  EXPECT_NEAR(belief.modes[0].mass, 0.8, 1e-6);
  EXPECT_NEAR(belief.modes[0].map_from_robot.x, 1.1, 1e-6);
  EXPECT_NEAR(belief.modes[0].covariance[0], 0.01, 1e-4);
  EXPECT_NEAR(belief.modes[1].map_from_robot.x, 5.0, 1e-6);
}

}  // namespace
}  // namespace docent::localization::belief_summary_test
