#include "docent/collision_avoidance/local_planner/window_planners.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

namespace docent::collision_avoidance::window_planners_test {
namespace {

constexpr double kTop = 0.7;  // [m/s]

/// Both planners, by their names in robot.yaml.
std::unique_ptr<LocalPlanner> planner(const std::string& method) {
  if (method == "plain") return std::make_unique<PlainWindow>(BaseLimits{}, DynamicWindowParams{});
  return std::make_unique<CautiousWindow>(BaseLimits{}, DynamicWindowParams{});
}

class WindowPlanners : public ::testing::TestWithParam<const char*> {
 protected:
  LocalPlan plan(Point2 carrot, double speed = 0.4) {
    const std::vector<Point2> path{carrot};
    return planner_->plan({{speed, 0.0}, {speed, 0.0}, {}, obstacles_, path, carrot, kTop, {kTop, "slow"}});
  }
  /// A wall across the way, `ahead` metres before the robot's centre.
  void wall(double ahead) {
    for (double y = -1.0; y <= 1.0; y += 0.05) obstacles_.push_back({.at = {ahead, y}, .margin = 0.08});
  }
  std::vector<Obstacle> obstacles_;
  std::unique_ptr<LocalPlanner> planner_ = planner(GetParam());
};
INSTANTIATE_TEST_SUITE_P(Both, WindowPlanners, ::testing::Values("plain", "cautious"));

TEST_P(WindowPlanners, SpeedUpInTheOpenAndSayWhyTheyAreNoFaster) {
  const LocalPlan open = plan({3.0, 0.0});
  EXPECT_GT(open.command.linear, 0.4);
  EXPECT_NEAR(open.command.angular, 0.0, 0.1);
  EXPECT_FALSE(open.is_braking);
  EXPECT_EQ(open.cap.speed, kTop);
  EXPECT_EQ(open.cap.reason, "slow");
  EXPECT_FALSE(open.window.empty());
}

TEST_P(WindowPlanners, TurnOnTheSpotWhenTheWayLiesBehind) {
  const LocalPlan back = plan({-2.0, 0.5}, 0.0);
  EXPECT_EQ(back.cap.speed, 0.0);
  EXPECT_EQ(back.command.linear, 0.0);
  EXPECT_GT(back.command.angular, 0.1);
  EXPECT_LT(plan({0.5, 2.0}, 0.0).cap.speed, kTop) << "sharp turns slowly";
}

TEST_P(WindowPlanners, BrakeWhereNothingIsSafe) {
  wall(0.42);
  const LocalPlan late = plan({3.0, 0.0}, 0.6);
  EXPECT_TRUE(late.is_braking);
  EXPECT_EQ(late.command, Velocity{});
}

TEST(PlainWindow, SteersStraightAndKeepsItsSpeedNearThings) {
  PlainWindow window{BaseLimits{}, DynamicWindowParams{}};
  const std::vector<Obstacle> beside{{.at = {0.1, 0.42}, .margin = 0.08}};
  const std::vector<Point2> path{{3.0, 0.0}};
  const LocalPlan plan = window.plan({{0.4, 0.0}, {0.4, 0.0}, {}, beside, path, path[0], kTop, {kTop, ""}});
  EXPECT_EQ(plan.cap.speed, kTop);
  EXPECT_EQ(plan.cap.reason, "");
}

TEST(CautiousWindow, IsSlowNearThingsByTheirKindAndNotForWhatLiesBehindOrIsUnknown) {
  CautiousWindow window{BaseLimits{}, DynamicWindowParams{}};
  const std::vector<Point2> path{{3.0, 0.0}};
  const auto plan = [&](const Obstacle& obstacle) {
    window.forget();
    const std::vector<Obstacle> obstacles{obstacle};
    return window.plan({{0.4, 0.0}, {0.4, 0.0}, {}, obstacles, path, path[0], kTop, {kTop, ""}});
  };
  const LocalPlan beside = plan({.at = {0.1, 0.42}, .margin = 0.08});
  EXPECT_LT(beside.cap.speed, kTop);
  EXPECT_EQ(beside.cap.reason, "obstacle_near");
  EXPECT_EQ(plan({.at = {0.1, 0.42}, .margin = 0.08, .is_virtual = true}).cap.reason, "hazard_near");
  EXPECT_EQ(plan({.at = {0.0, 0.1}, .margin = 0.07, .is_virtual = true, .is_border = true}).cap.reason, "border_near");
  EXPECT_EQ(plan({.at = {-0.42, 0.0}, .margin = 0.08}).cap.speed, kTop) << "behind";
  EXPECT_EQ(plan({.at = {0.1, 0.42}, .margin = 0.08, .is_unknown = true}).cap.speed, kTop);
}

TEST(CautiousWindow, LeadsRoundWhatStandsBeforeItAndForgetsItsSide) {
  CautiousWindow window{BaseLimits{}, DynamicWindowParams{}};
  const std::vector<Point2> path{{2.0, 0.0}};
  const auto turn_round = [&](double y) {
    const std::vector<Obstacle> obstacles{{.at = {0.7, y}, .margin = 0.08}};
    return window.plan({{0.1, 0.0}, {0.1, 0.0}, {}, obstacles, path, path[0], kTop, {kTop, ""}}).command.angular;
  };
  EXPECT_LT(turn_round(0.03), 0.0);
  EXPECT_LT(turn_round(-0.01), 0.0) << "noise does not change its mind";
  window.forget();
  EXPECT_GT(turn_round(-0.03), 0.0);
}

}  // namespace
}  // namespace docent::collision_avoidance::window_planners_test
