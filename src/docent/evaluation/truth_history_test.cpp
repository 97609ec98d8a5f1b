#include "docent/evaluation/truth_history.h"

#include <gtest/gtest.h>

#include "docent/messages/conversions.h"

namespace docent::evaluation {
namespace {

TEST(TruthHistory, InterpolatesBetweenStatesAlsoOverTheHalfTurn) {
  TruthHistory history;
  for (int i = 0; i <= 300; ++i) {
    docent_msgs::TrueState state;
    state.header.stamp = to_message(time_from_seconds(0.1 * i));
    state.x = 0.1 * i;
    state.theta = Angle::radians(0.1 * i).radians();
    history.add(std::make_shared<const docent_msgs::TrueState>(state));
  }
  for (const double time : {12.0, 15.75, 29.93, 30.0}) {
    const auto pose = history.pose_at(time_from_seconds(time));
    ASSERT_TRUE(pose);
    EXPECT_NEAR(pose->x, time, 1e-9);
    EXPECT_NEAR((pose->theta - Angle::radians(time)).radians(), 0.0, 1e-9);
  }
  EXPECT_FALSE(history.pose_at(time_from_seconds(30.01)));
  EXPECT_FALSE(history.pose_at(time_from_seconds(5.0)));  // forgotten
  ASSERT_NE(history.state_at(time_from_seconds(20.04)), nullptr);
  EXPECT_NEAR(history.state_at(time_from_seconds(20.04))->x, 20.0, 1e-9);
  EXPECT_EQ(history.state_at(time_from_seconds(31.0)), nullptr);
}

}  // namespace
}  // namespace docent::evaluation
