#include "docent/motion_models/odometry_history.h"

#include <gtest/gtest.h>

namespace docent::motion_models {
namespace {

TEST(OdometryHistory, InterpolatesAlsoAcrossTheTurnOfAngles) {
  OdometryHistory history;
  EXPECT_FALSE(history.at(Time{}).has_value());
  history.add(time_from_seconds(1.0), {0.0, 0.0, Angle::degrees(170)});
  history.add(time_from_seconds(2.0), {1.0, 2.0, Angle::degrees(-170)});
  const auto middle = history.at(time_from_seconds(1.5));
  ASSERT_TRUE(middle.has_value());
  EXPECT_NEAR(middle->x, 0.5, 1e-9);
  EXPECT_NEAR(middle->y, 1.0, 1e-9);
  EXPECT_NEAR(std::abs(middle->theta.degrees()), 180.0, 1e-9);
  EXPECT_NEAR(history.at(time_from_seconds(1.0))->theta.degrees(), 170.0, 1e-9);
}

TEST(OdometryHistory, KnowsNeitherThePastNorTheFuture) {
  OdometryHistory history{seconds(1.0)};
  for (int i = 0; i <= 30; ++i) history.add(time_from_seconds(0.1 * i), {0.1 * i, 0.0, {}});
  EXPECT_FALSE(history.at(time_from_seconds(1.5)).has_value());
  EXPECT_TRUE(history.at(time_from_seconds(2.5)).has_value());
  EXPECT_DOUBLE_EQ(history.at(time_from_seconds(3.15))->x, history.latest().x);
  EXPECT_FALSE(history.at(time_from_seconds(3.5)).has_value());
  history.add(time_from_seconds(2.0), {99.0, 0.0, {}});  // late: left out
  EXPECT_NEAR(history.latest().x, 3.0, 1e-9);
}

TEST(OdometryHistory, OneStampFromTheFutureDoesNotEndIt) {
  OdometryHistory history;
  for (int i = 0; i <= 10; ++i) history.add(time_from_seconds(0.1 * i), {0.1 * i, 0.0, {}});
  history.add(time_from_seconds(3600.0), {99.0, 0.0, {}});
  for (int i = 12; i <= 14; ++i) history.add(time_from_seconds(0.1 * i), {0.1 * i, 0.0, {}});
  EXPECT_NEAR(history.at(time_from_seconds(1.3))->x, 1.3, 1e-9);
}

TEST(OdometryHistory, OfOneTimeTheNewestCounts) {
  OdometryHistory history;
  history.add(time_from_seconds(1.0), {1.0, 0.0, {}});
  history.add(time_from_seconds(2.0), {2.0, 0.0, {}});
  history.add(time_from_seconds(2.0), {2.5, 0.0, {}});
  EXPECT_NEAR(history.latest().x, 2.5, 1e-9);
  EXPECT_NEAR(history.at(time_from_seconds(1.5))->x, 1.75, 1e-9);
  history.forget();
  EXPECT_TRUE(history.empty());
}

}  // namespace
}  // namespace docent::motion_models
