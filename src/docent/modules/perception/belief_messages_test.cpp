#include "docent/modules/perception/belief_messages.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace docent::modules::belief_messages_test {
namespace {

constexpr Time kStamp{2'000'000'007};

TEST(BeliefMessages, TheRestIsARasterFromItsLowerLeftCorner) {
  localization::BeliefSummary summary;
  summary.rest_origin = {-1.5, 2.5};
  summary.rest_cell_size = 0.5;
  summary.rest_columns = 3;
  summary.rest_rows = 2;
  summary.rest = {0.0F, 0.1F, 0.2F, 0.3F, 0.0F, 0.4F};
  const docent_msgs::CoarseBelief rest = rest_message(summary);
  EXPECT_EQ(rest.origin_x, -1.5F);
  EXPECT_EQ(rest.origin_y, 2.5F);
  EXPECT_EQ(rest.cell_size, 0.5F);
  EXPECT_EQ(rest.columns, 3U);
  EXPECT_EQ(rest.rows, 2U);
  EXPECT_EQ(rest.mass, summary.rest);
}

TEST(BeliefMessages, ABeliefIsToldInCellsModesAndRest) {
  localization::BeliefSummary summary;
  summary.cells = {{1.0F, 2.0F, 0.5F, 0.75F}};
  summary.modes = {{{1.5, 2.5, Angle::radians(0.25)}, {11, 12, 13, 21, 22, 23, 31, 32, 33}, 0.875}};
  summary.rest = {0.25F};
  summary.entropy = 3.0;
  summary.active_mass = 0.5;
  summary.active_states = 7;
  const docent_msgs::Belief message = belief_message(summary, kStamp);
  EXPECT_EQ(message.header.frame_id, "map");
  EXPECT_EQ(message.header.stamp.nanosec, 7U);
  ASSERT_EQ(message.cells.size(), 1U);
  EXPECT_EQ(message.cells[0].y, 2.0F);
  EXPECT_EQ(message.cells[0].mass, 0.75F);
  ASSERT_EQ(message.hypotheses.size(), 1U);
  EXPECT_EQ(message.hypotheses[0].x, 1.5);
  EXPECT_EQ(message.hypotheses[0].theta, 0.25);
  EXPECT_EQ(message.hypotheses[0].covariance[5], 23.0);
  EXPECT_EQ(message.hypotheses[0].mass, 0.875);
  EXPECT_EQ(message.rest.mass, summary.rest);
  EXPECT_EQ(message.entropy, 3.0F);
  EXPECT_EQ(message.active_mass, 0.5F);
  EXPECT_EQ(message.active_cells, 7U);
}

TEST(BeliefMessages, AVerdictIsToldWithItsReasons) {
  const localization::Verdict verdict{{}};
  docent_msgs::Belief message;
  message.p_lost = 0.123F;
  message.confirmation = 0.5F;
  add_verdict(message, verdict);
  EXPECT_FLOAT_EQ(static_cast<float>(message.p_lost), static_cast<float>(verdict.p_lost()));
  EXPECT_EQ(message.confirmation, static_cast<float>(verdict.confirmation()));
  EXPECT_EQ(message.share, static_cast<float>(verdict.share()));
}

TEST(BeliefMessages, OdomIsAChildOfTheMap) {
  const tf2_msgs::TFMessage message = odom_in_map_message({1.0, -2.0, Angle::degrees(90.0)}, kStamp);
  ASSERT_EQ(message.transforms.size(), 1U);
  const auto& transform = message.transforms.front();
  EXPECT_EQ(transform.header.frame_id, "map");
  EXPECT_EQ(transform.child_frame_id, "odom");
  EXPECT_EQ(transform.header.stamp.sec, 2);
  EXPECT_EQ(transform.header.stamp.nanosec, 7U);
  EXPECT_EQ(transform.transform.translation.x, 1.0);
  EXPECT_EQ(transform.transform.translation.y, -2.0);
  EXPECT_NEAR(transform.transform.rotation.z, std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(transform.transform.rotation.w, std::sqrt(0.5), 1e-12);
}

TEST(BeliefMessages, TheCovarianceOfAPoseStandsWhereRosLooksForIt) {
  const localization::BeliefMode mode{{1.0, 2.0, Angle{}}, {11, 12, 13, 21, 22, 23, 31, 32, 33}, 0.9};
  const auto message = pose_message(mode, kStamp);
  EXPECT_EQ(message.header.frame_id, "map");
  EXPECT_EQ(message.pose.pose.position.x, 1.0);
  EXPECT_EQ(message.pose.pose.position.y, 2.0);
  const auto& covariance = message.pose.covariance;  // 6 x 6: x, y, z, roll, pitch, yaw
  const std::vector<double> of_three{covariance[0],  covariance[1],  covariance[5],  covariance[6], covariance[7],
                                     covariance[11], covariance[30], covariance[31], covariance[35]};
  EXPECT_EQ(of_three, (std::vector<double>{11, 12, 13, 21, 22, 23, 31, 32, 33}));
  double sum = 0.0;
  for (const double entry : covariance) sum += entry;
  EXPECT_EQ(sum, 198.0) << "nothing is said of height, roll and pitch";
}

}  // namespace
}  // namespace docent::modules::belief_messages_test
