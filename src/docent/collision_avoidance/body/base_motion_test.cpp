#include "docent/collision_avoidance/body/base_motion.h"

#include <gtest/gtest.h>

#include <cmath>

namespace docent::collision_avoidance::base_motion_test {
namespace {

TEST(BaseMotion, BrakesInTheKnownDistance) {
  const BaseLimits limits;
  BaseState state{{}, {0.8, 0.0}};
  for (int i = 0; i < 200; ++i) state = advance(state, {}, limits, 0.01);
  EXPECT_EQ(state.velocity.linear, 0.0);
  EXPECT_NEAR(state.odom_from_base.x, 0.32, 1e-3);
}

TEST(BaseMotion, GoesThroughStandingWhenTheDirectionChanges) {
  const BaseLimits limits;
  BaseState state{{}, {0.2, 0.0}};
  state = advance(state, {-0.5, 0.0}, limits, 0.3);  // 0.2 s to stop, 0.1 s of acceleration
  EXPECT_NEAR(state.velocity.linear, -0.05, 1e-9);
}

TEST(CommandHistory, TheWheelsFeelACommandOneLatencyLater) {
  const BaseLimits limits;
  CommandHistory commands;
  commands.add(time_from_seconds(1.0), {0.5, 0.0});
  const BaseState start{};
  EXPECT_EQ(predict(start, time_from_seconds(1.0), time_from_seconds(1.15), commands, limits).velocity.linear, 0.0);
  EXPECT_NEAR(predict(start, time_from_seconds(1.0), time_from_seconds(1.35), commands, limits).velocity.linear, 0.1,
              0.01);
}

TEST(BaseHistory, InterpolatesAndCarriesOn) {
  BaseHistory history;
  history.add(time_from_seconds(1.0), {{0.0, 0.0, Angle::degrees(170)}, {}});
  history.add(time_from_seconds(2.0), {{1.0, 0.0, Angle::degrees(-170)}, {0.5, 0.0}});
  EXPECT_NEAR(history.pose_at(time_from_seconds(1.5)).x, 0.5, 1e-9);
  EXPECT_NEAR(std::abs(history.pose_at(time_from_seconds(1.5)).theta.degrees()), 180.0, 1e-6);
  EXPECT_NEAR(history.pose_at(time_from_seconds(2.2)).x, 1.0 - 0.1 * std::cos(0.1745), 1e-3);
  EXPECT_NEAR(history.pose_at(time_from_seconds(0.0)).x, 0.0, 1e-9);
  EXPECT_NEAR(history.driven_since(time_from_seconds(1.5)), 1.0, 1e-9);
  EXPECT_EQ(history.driven_since(time_from_seconds(2.0)), 0.0);
}

TEST(Predict, FromAStateOfLongAgoIsDoneAtOnce) {
  const BaseState state{{1.0, 2.0, Angle{}}, {0.5, 0.0}};
  const Time now = time_from_seconds(1e9);
  const BaseState then = predict(state, Time{}, now, CommandHistory{}, BaseLimits{});
  EXPECT_EQ(then.velocity.linear, 0.0);
  EXPECT_LT(then.odom_from_base.x, 1.5) << "it braked";
}

}  // namespace
}  // namespace docent::collision_avoidance::base_motion_test
