#include "docent/modules/drive/plan_module.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "docent/modules/shared/module_bench.h"

namespace docent::modules {
namespace {

constexpr double kSide = 12.0;        // [m] of the hall
constexpr double kResolution = 0.05;  // [m/cell]
constexpr int kCells = 240;
constexpr int kLive = 80;  // cells of the live map along a side, 15 cm each

/// A hall with a wall at x = 6 m that two doors lead through: one in the middle, the other at the northern end.
OccupancyGrid hall() {
  OccupancyGrid map;
  map.frame = {kCells, kCells, kResolution, {0.0, 0.0}};
  map.cells.assign(map.frame.size(), 0);
  for (int row = 0; row < kCells; ++row) {
    for (int column = 0; column < kCells; ++column) {
      const Point2 at = map.frame.centre({column, row});
      const bool is_door = std::abs(at.y - 6.0) < 0.9 || std::abs(at.y - 10.5) < 0.9;
      const bool is_wall = (std::abs(at.x - 6.0) < 0.15 && !is_door) || std::min(at.x, at.y) < 0.15 ||
                           std::max(at.x, at.y) > kSide - 0.15;
      if (is_wall) map.cells[map.frame.index({column, row})] = 100;
    }
  }
  return map;
}

/// A robot at (3, 6) of the map. Odometry has its origin there and turns the axes by 90 degrees.
class PlanModule : public ModuleBench {
 protected:
  PlanModule() : ModuleBench{"plan", make_plan} {
    museum.map = hall();
    museum.area = {{0, 0}, {kSide, 0}, {kSide, kSide}, {0, kSide}};
    keep(topics::kTarget, target, targets);
    keep(topics::kGoalState, state_of_goal, states);
    world->every(seconds(0.1), [this] { tick(); });
  }
  void tick() {
    nav_msgs::Odometry reading;
    reading.header = {to_message(hub.now()), "odom"};
    reading.pose.pose = to_message(odom_from_base);
    odometry.publish(reading);
    if (!believes) return;
    docent_msgs::Belief belief;
    belief.header = {to_message(hub.now()), "map"};
    belief.localized = localized;
    belief.hypotheses.push_back({map_from_base.x, map_from_base.y, map_from_base.theta.radians(), {}, 1.0});
    belief.odom_pose = to_message(odom_from_base);
    beliefs.publish(belief);
  }
  void want(const std::string& id, Point2 place) {
    docent_msgs::DriveGoal goal;
    goal.id = id;
    goal.x = place.x;
    goal.y = place.y;
    goals.publish(goal);
  }
  /// The live map as it is said whole: free but for the middle door, if that is closed.
  [[nodiscard]] nav_msgs::OccupancyGrid live_map(bool closed, int side = kLive) const {
    nav_msgs::OccupancyGrid map;
    map.header = {to_message(time_from_seconds(0.5)), "map"};
    map.info.width = map.info.height = static_cast<std::uint32_t>(side);
    map.info.resolution = 0.15F;
    map.data.assign(static_cast<std::size_t>(side) * static_cast<std::size_t>(side), 0);
    for (int row = 32; row < 48 && closed; ++row) map.data[static_cast<std::size_t>(row * side + 40)] = 100;
    return map;
  }
  /// The middle door closed, as a numbered rectangle.
  [[nodiscard]] static docent_msgs::LiveMapUpdate closed_door(std::uint32_t number, double base = 0.5) {
    docent_msgs::LiveMapUpdate update;
    update.base = to_message(time_from_seconds(base));
    update.number = number;
    update.x = 40;
    update.y = 32;
    update.width = 1;
    update.height = 16;
    update.data.assign(16, 100);
    return update;
  }

  Pose2 map_from_base{3.0, 6.0, Angle{}};
  Pose2 odom_from_base{0.0, 0.0, Angle::degrees(90.0)};
  bool believes = true, localized = true;
  transport::Publisher<nav_msgs::Odometry> odometry = world->publisher(topics::kOdometry);
  transport::Publisher<docent_msgs::Belief> beliefs = world->publisher(topics::kBelief);
  transport::Publisher<docent_msgs::DriveGoal> goals = world->publisher(topics::kDriveGoal);
  transport::Publisher<nav_msgs::OccupancyGrid> live_maps = world->publisher(topics::kLiveMap);
  transport::Publisher<docent_msgs::LiveMapUpdate> updates = world->publisher(topics::kLiveMapUpdate);
  docent_msgs::Target target;
  docent_msgs::GoalState state_of_goal;
  int targets = 0, states = 0;
};

TEST_F(PlanModule, PutsTheWayIntoOdometrysFrame) {
  start();
  run(1.0);
  EXPECT_EQ(target.mode, "stop");
  EXPECT_EQ(state_of_goal.state, "idle");
  want("g1", {9.0, 6.0});
  run(2.0);
  EXPECT_EQ(target.goal_id, "g1");
  EXPECT_EQ(target.header.frame_id, "odom");
  ASSERT_EQ(target.mode, "drive");
  ASSERT_FALSE(target.via_x.empty());
  for (std::size_t i = 0; i < target.via_x.size(); ++i) {  // the way leads east; the robot's x axis is odometry's y
    EXPECT_NEAR(target.via_x[i], 0.0, 0.5);
    EXPECT_GT(target.via_y[i], -0.1);
  }
  EXPECT_EQ(state_of_goal.id, "g1");
  EXPECT_EQ(state_of_goal.state, "driving");
  EXPECT_NEAR(state_of_goal.remaining_m, 6.0, 0.6);
  const int before = targets;
  run(1.0);
  EXPECT_EQ(targets - before, 5) << "collision avoidance takes a target of a second ago for none";
}

TEST_F(PlanModule, StandsWhenTheBeliefIsUnsureOrOldOrNeverCame) {
  believes = false;
  start();
  want("g1", {9.0, 6.0});
  run(2.0);
  EXPECT_EQ(target.mode, "stop");
  EXPECT_EQ(state_of_goal.state, "waiting");
  EXPECT_EQ(module->health().reason, "no belief");
  believes = true;
  run(1.0);
  EXPECT_EQ(target.mode, "drive");
  EXPECT_EQ(module->health().state, "ready");
  believes = false;  // odometry goes on
  run(2.5);
  EXPECT_EQ(target.mode, "drive");
  run(1.0);
  EXPECT_EQ(target.mode, "stop") << "3 s are too long to drive on";
  EXPECT_EQ(state_of_goal.reason, "the position is not known");
  believes = true;
  localized = false;
  run(1.0);
  EXPECT_EQ(target.mode, "stop");
}

TEST_F(PlanModule, TakesTheLiveMapInItsOrderAndOnlyIfItIsOfThisBuilding) {
  start();
  live_maps.publish(live_map(false));
  want("g1", {9.0, 6.0});
  run(2.0);
  const double straight = state_of_goal.remaining_m;
  ASSERT_NEAR(straight, 6.0, 0.6);
  const auto stays = [&](const char* why) {
    run(2.0);
    EXPECT_NEAR(state_of_goal.remaining_m, straight, 0.3) << why;
  };
  auto other = live_map(true, kLive - 1);
  std::fill(other.data.begin(), other.data.end(), std::int8_t{100});
  live_maps.publish(other);
  stays("a map of another building");
  updates.publish(closed_door(2));
  stays("the first rectangle was lost");
  updates.publish(closed_door(1, 0.4));
  stays("a rectangle of an older map");
  updates.publish(closed_door(1));
  run(3.0);
  EXPECT_GT(state_of_goal.remaining_m, straight + 2.0) << "the middle door is closed: through the other";
  live_maps.publish(live_map(false));
  run(3.0);
  EXPECT_NEAR(state_of_goal.remaining_m, straight, 0.3) << "the whole map counts from there on";
}

TEST_F(PlanModule, ALostRobotTurnsUntilItKnowsItsPlaceAndStandsThen) {
  localized = false;
  start();
  docent_msgs::DriveGoal goal;
  goal.id = "look";
  goal.relocalize = true;
  goals.publish(goal);
  run(1.0);
  EXPECT_EQ(target.mode, "turn") << "without sweeps nothing else is safe";
  EXPECT_EQ(target.goal_id, "look");
  EXPECT_EQ(state_of_goal.state, "waiting");
  localized = true;
  run(0.5);
  EXPECT_EQ(target.mode, "stop");
  EXPECT_EQ(state_of_goal.state, "arrived");
}

TEST_F(PlanModule, ANewProcessGoesOnWithTheGoalThatHolds) {
  start();
  want("g1", {9.0, 6.0});
  run(2.0);
  kill();
  const int before = targets;
  run(2.0);
  EXPECT_EQ(targets, before);
  start();
  run(1.5);
  EXPECT_EQ(target.goal_id, "g1");
  EXPECT_EQ(target.mode, "drive");
  want("", {});
  run(0.5);
  EXPECT_EQ(target.mode, "stop") << "no goal: it stays";
  EXPECT_EQ(state_of_goal.state, "idle");
}

}  // namespace
}  // namespace docent::modules
