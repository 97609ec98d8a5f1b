#include "docent/collision_avoidance/local_planner/bearing_choice.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace docent::collision_avoidance::bearing_choice_test {
namespace {

constexpr double kRadius = 0.25;

TEST(BearingChoice, SteersStraightWhereNothingStands) {
  BearingChoice choice{kRadius};
  EXPECT_NEAR(choice.choose({1.0, 1.0}, {}, {}), Angle::degrees(45).radians(), 1e-9);
}

TEST(BearingChoice, GoesRoundAndKeepsToItsSide) {
  BearingChoice choice{kRadius};
  const std::vector<Obstacle> left{{.at = {0.7, 0.03}, .margin = 0.08}};
  const double first = choice.choose({1.5, 0.0}, {}, left);
  EXPECT_LT(first, -0.2) << "the thing stands a little to the left";
  const std::vector<Obstacle> right{{.at = {0.7, -0.06}, .margin = 0.08}};
  EXPECT_LT(choice.choose({1.5, 0.0}, {}, right), -0.2) << "noise does not change the side";
  choice.forget();
  EXPECT_GT(choice.choose({1.5, 0.0}, {}, right), 0.2);
}

TEST(BearingChoice, TurnsTheSameWayToWhatLiesBehind) {
  BearingChoice choice{kRadius};
  const double first = choice.choose({-2.0, 0.05}, {}, {});
  EXPECT_GT(first, 2.0);
  EXPECT_EQ(choice.choose({-2.0, -0.05}, {}, {}), first);
  (void)choice.choose({2.0, 0.0}, {}, {});
  EXPECT_LT(choice.choose({-2.0, -0.05}, {}, {}), -2.0) << "another turn";
}

TEST(BearingChoice, SlidesOutOfAHazardsMarginButWaitsForWhoStandsAhead) {
  const Obstacle beside{.at = {0.1, -0.85}, .margin = 0.08};
  const std::vector<Obstacle> hazard{{.at = {0.3, 0.1}, .margin = 0.15, .is_virtual = true}, beside};
  const std::vector<Obstacle> somebody{{.at = {0.3, 0.1}, .margin = 0.08}, beside};
  BearingChoice slides{kRadius};
  EXPECT_LT(slides.choose({1.0, 0.0}, {}, hazard), -1.0);
  BearingChoice waits{kRadius};
  EXPECT_NEAR(waits.choose({1.0, 0.0}, {}, somebody), 0.0, 1e-9);
}

}  // namespace
}  // namespace docent::collision_avoidance::bearing_choice_test
