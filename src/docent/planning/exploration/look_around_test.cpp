#include "docent/planning/exploration/look_around.h"

#include <gtest/gtest.h>

#include <vector>

namespace docent::planning::look_around_test {
namespace {

/// Turns the robot as told for up to `seconds_left`; returns the first drive.
std::optional<LookAroundStep> turn_until_drive(LookAround& look, const std::vector<double>& clearances, double limit) {
  Pose2 pose{1, 1, {}};
  for (double t = 0.0; t < limit; t += 0.25) {
    const auto step = look.step(
        pose, clearances, [] { return std::nullopt; }, time_from_seconds(t));
    if (step.drive) return step;
    pose.theta = pose.theta + Angle::degrees(10);
  }
  return std::nullopt;
}

TEST(LookAround, TurnsOnceThenDrivesWhereItIsFree) {
  LookAround look;
  look.start(Time{});
  std::vector<double> clearances(180, 0.8);
  for (std::size_t i = 120; i < 160; ++i) clearances[i] = 3.0;  // 60 to 138 degrees to the left
  const auto step = turn_until_drive(look, clearances, 60);
  ASSERT_TRUE(step.has_value());
  EXPECT_GT(distance(step->via, {1, 1}), 1.0);
}

TEST(LookAround, MakesDoWithAFewDecimetresWhereNoMoreIsFree) {
  LookAround look;
  look.start(Time{});
  std::vector<double> clearances(180, 0.6);
  for (std::size_t i = 120; i < 160; ++i) clearances[i] = 0.8;
  const auto step = turn_until_drive(look, clearances, 60);
  ASSERT_TRUE(step.has_value());
  const double way = distance(step->via, {1, 1});
  EXPECT_GT(way, 0.3);
  EXPECT_LT(way, 0.42) << "off what is there";
  EXPECT_LT(step->tolerance, 0.5 * way) << "else it would be there at once";
}

TEST(LookAround, RatherGoesOnThanBack) {
  LookAround look;
  look.start(Time{});
  const auto nowhere = [] { return std::nullopt; };
  const auto turned = [&](Pose2 pose, double from) {
    for (double t = from; t < from + 60.0; t += 0.25) {
      // Free to the east and to the west of the corridor, farther to the west.
      std::vector<double> free(180, 0.6);
      for (int i = 0; i < 180; ++i) {
        const double in_odom = (pose.theta + Angle::degrees(-180.0 + 2.0 * i)).degrees();
        if (std::abs(in_odom) < 25.0) free[static_cast<std::size_t>(i)] = 1.6;
        if (std::abs(in_odom) > 155.0) free[static_cast<std::size_t>(i)] = 2.0;
      }
      const auto step = look.step(pose, free, nowhere, time_from_seconds(t));
      if (step.drive) return step.via;
      pose.theta = pose.theta + Angle::degrees(10);
    }
    return Point2{};
  };
  EXPECT_LT(turned({0.0, 0.0, {}}, 0.0).x, -1.0) << "the farther way";
  EXPECT_LT(turned({-1.3, 0.0, {}}, 60.0).x, -2.0) << "on";
}

TEST(LookAround, OnlyTurnsWhereNothingIsFreeAndTellsSinceWhen) {
  LookAround look;
  look.start(Time{});
  EXPECT_FALSE(turn_until_drive(look, std::vector<double>(180, 0.6), 120).has_value());
  EXPECT_TRUE(look.is_hemmed_in());
  EXPECT_GT(look.held_up_s(time_from_seconds(120.0)), 60.0);
  look.start(Time{});
  EXPECT_FALSE(turn_until_drive(look, {}, 120).has_value());
}

TEST(LookAround, LeavesADriveThatIsHeldUpAndTurnsAgain) {
  LookAround look;
  look.start(Time{});
  const std::vector<double> clearances(180, 3.0);
  const auto telling = [] { return Point2{2, 0}; };
  const Pose2 pose{1, 1, {}};
  EXPECT_TRUE(look.step(pose, clearances, telling, Time{}).drive);
  EXPECT_TRUE(look.step(pose, clearances, telling, time_from_seconds(5.0)).drive);
  EXPECT_NEAR(look.held_up_s(time_from_seconds(5.0)), 5.0, 1e-9);
  const Pose2 nearer{1.3, 1, {}};  // it goes on
  EXPECT_TRUE(look.step(nearer, clearances, telling, time_from_seconds(8.0)).drive);
  EXPECT_TRUE(look.step(nearer, clearances, telling, time_from_seconds(12.0)).drive);
  const auto nowhere = [] { return std::nullopt; };
  EXPECT_FALSE(look.step(nearer, clearances, nowhere, time_from_seconds(18.0)).drive);
  EXPECT_EQ(look.held_up_s(time_from_seconds(18.0)), 0.0);
}

}  // namespace
}  // namespace docent::planning::look_around_test
