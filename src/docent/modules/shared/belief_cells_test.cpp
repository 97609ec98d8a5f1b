#include "docent/modules/shared/belief_cells.h"

#include <gtest/gtest.h>

namespace docent::modules::belief_cells_test {
namespace {

TEST(BeliefCells, AreToldWithTheModesAndWithoutTheRest) {
  localization::BeliefSummary summary;
  summary.cells = {{1.0F, 2.0F, 0.5F, 0.75F}, {3.0F, 4.0F, 0.25F, 0.125F}};
  summary.modes = {{{1.5, 2.5, Angle::radians(0.25)}, {11, 12, 13, 21, 22, 23, 31, 32, 33}, 0.875}};
  summary.rest = {0.25F};
  const docent_msgs::Belief message = belief_cells_message(summary, Time{2'000'000'007});
  EXPECT_EQ(message.header.frame_id, "map");
  EXPECT_EQ(message.header.stamp.sec, 2);
  EXPECT_EQ(message.header.stamp.nanosec, 7U);
  ASSERT_EQ(message.cells.size(), 2U);
  EXPECT_EQ(message.cells[0].x, 1.0F);
  EXPECT_EQ(message.cells[0].y, 2.0F);
  EXPECT_EQ(message.cells[0].theta, 0.5F);
  EXPECT_EQ(message.cells[0].mass, 0.75F);
  EXPECT_EQ(message.cells[1].mass, 0.125F);
  ASSERT_EQ(message.hypotheses.size(), 1U);
  EXPECT_EQ(message.hypotheses[0].x, 1.5);
  EXPECT_EQ(message.hypotheses[0].theta, 0.25);
  EXPECT_EQ(message.hypotheses[0].covariance[5], 23.0);
  EXPECT_EQ(message.hypotheses[0].mass, 0.875);
  EXPECT_TRUE(message.rest.mass.empty());
}

}  // namespace
}  // namespace docent::modules::belief_cells_test
