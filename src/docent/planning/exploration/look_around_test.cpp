#include "docent/planning/exploration/look_around.h"

#include <gtest/gtest.h>

#include <vector>

namespace docent {
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

TEST(LookAround, OnlyTurnsWhereNothingIsFree) {
  LookAround look;
  look.start(Time{});
  EXPECT_FALSE(turn_until_drive(look, std::vector<double>(180, 0.9), 120).has_value());
  look.start(Time{});
  EXPECT_FALSE(turn_until_drive(look, {}, 120).has_value());
}

}  // namespace
}  // namespace docent
