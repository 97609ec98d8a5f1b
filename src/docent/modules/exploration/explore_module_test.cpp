#include "docent/modules/exploration/explore_module.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "docent/modules/shared/module_bench.h"

namespace docent::modules {
namespace {

/// A shut room of 6 x 4 m in which the robot goes where it is told at once.
class ExploreModule : public ModuleBench {
 protected:
  ExploreModule() : ModuleBench{"explore", make_explore} {
    museum.home = {1.5, 2.0, {}};
    keep(topics::kExploration, exploration, explorations);
    keep(topics::kBelief, belief, beliefs);
    keep(topics::kTarget, target, targets);
  }
  /// Odometry and both lasers, as seen from `pose` in the room; odometry's frame is the robot's first pose.
  void sense(const Pose2& pose) {
    nav_msgs::Odometry moved;
    moved.header.stamp = to_message(hub.now());
    moved.pose.pose = to_message(inverse(museum.home) * pose);
    odometry.publish(moved);
    run(0.001);
    for (const auto* topic : {&topics::kScanRear, &topics::kScanFront}) {
      const Angle heading = topic == &topics::kScanFront ? Angle{} : Angle::degrees(180.0);
      sensor_msgs::LaserScan scan;
      scan.header.stamp = to_message(hub.now());
      scan.angle_min = static_cast<float>(-0.5 * std::numbers::pi);
      scan.angle_increment = static_cast<float>(std::numbers::pi / 180.0);
      scan.range_min = 0.02F;
      scan.range_max = 10.0F;
      for (int i = 0; i < 181; ++i) {
        const Point2 along = unit(pose.theta + heading + Angle::degrees(i - 90.0));
        const double to_x = std::abs(along.x) < 1e-9 ? 99.0 : ((along.x > 0 ? 6.02 : 0.02) - pose.x) / along.x;
        const double to_y = std::abs(along.y) < 1e-9 ? 99.0 : ((along.y > 0 ? 4.02 : 0.02) - pose.y) / along.y;
        scan.ranges.push_back(static_cast<float>(std::min(to_x, to_y)));
      }
      world->publisher(*topic).publish(scan);
    }
    run(0.099);
  }

  transport::Publisher<nav_msgs::Odometry> odometry = world->publisher(topics::kOdometry);
  docent_msgs::Exploration exploration;
  docent_msgs::Belief belief;
  docent_msgs::Target target;
  int explorations = 0, beliefs = 0, targets = 0;
};

TEST_F(ExploreModule, SaysThatItWaitsForItsLasers) {
  start();
  run(2.0);
  EXPECT_EQ(exploration.state, "starting");
  EXPECT_EQ(beliefs, 0) << "it knows nothing";
  EXPECT_EQ(target.mode, "stop");
  EXPECT_EQ(module->health().state, "degraded");
}

TEST_F(ExploreModule, KnowsWhereItBeganMapsTheRoomAndSavesIt) {
  start();
  sense(museum.home);
  ASSERT_GT(beliefs, 0);
  EXPECT_TRUE(belief.localized);
  EXPECT_NEAR(belief.hypotheses.front().x, 1.5, 1e-6);
  EXPECT_NEAR(belief.hypotheses.front().y, 2.0, 1e-6);
  EXPECT_EQ(module->health().state, "ready");
  for (int i = 0; i < 30; ++i) sense(museum.home * Pose2{0.08 * i, 0.0, {}});
  EXPECT_NEAR(belief.hypotheses.front().x, 1.5 + 0.08 * 29, 0.1);
  for (int i = 29; i > 0; --i) sense(museum.home * Pose2{0.08 * i, 0.0, {}});
  for (int i = 0; i < 600 && exploration.state != "done"; ++i) sense(museum.home);
  EXPECT_EQ(exploration.state, "done");
  EXPECT_NEAR(exploration.known_m2, 24.0, 2.0);
  EXPECT_TRUE(exploration.unreached_x.empty());
  EXPECT_TRUE(std::filesystem::exists(state / "explored" / "map.yaml"));
  EXPECT_EQ(exploration.map, (state / "explored" / "map.yaml").string());
  const auto map = load_map(state / "explored" / "map.yaml");
  ASSERT_TRUE(map) << map.error().message;
  EXPECT_TRUE(map->is_free(map->frame.cell_at({3.0, 2.0})));
  EXPECT_TRUE(map->is_occupied(map->frame.cell_at({6.02, 2.0})));
  EXPECT_EQ(target.mode, "stop");
}

TEST_F(ExploreModule, WaitsForATechnicianWhereItIsTold) {
  ASSERT_TRUE(config.set("explore.waits_for_order=true"));
  start();
  for (int i = 0; i < 30; ++i) sense(museum.home);
  EXPECT_EQ(exploration.order, "wait");
  EXPECT_EQ(target.mode, "stop") << "nobody has said that it may drive";
  world->publisher(topics::kExplorationOrder).publish({{}, "by_hand"});
  for (int i = 0; i < 30; ++i) sense(museum.home * Pose2{0.08 * i, 0.0, {}});
  EXPECT_EQ(exploration.order, "by_hand");
  EXPECT_EQ(target.mode, "stop") << "a hand drives it";
  EXPECT_EQ(exploration.state, "exploring") << "it does not end by itself";
  world->publisher(topics::kExplorationOrder).publish({{}, "finish"});
  for (int i = 0; i < 30; ++i) sense(museum.home * Pose2{0.08 * 29, 0.0, {}});
  EXPECT_EQ(exploration.state, "done");
  EXPECT_TRUE(std::filesystem::exists(state / "explored" / "map.yaml"));
  EXPECT_TRUE(std::filesystem::exists(state / "localize.yaml")) << "localize goes on from there";
}

TEST_F(ExploreModule, KeepsTheFrameOfItsMapWhenItBeginsAnew) {
  start();
  for (int i = 0; i < 40; ++i) sense(museum.home * Pose2{0.05 * i, 0.0, {}});
  start();
  sense(museum.home * Pose2{0.05 * 39, 0.0, {}});
  EXPECT_NEAR(belief.hypotheses.front().x, 1.5 + 0.05 * 39, 0.1) << "marks that people have made hold";
  kill();
  run(90.0);  // put away: nobody knows where it stands now
  start();
  sense(museum.home * Pose2{0.05 * 39, 0.0, {}});
  EXPECT_NEAR(belief.hypotheses.front().x, 1.5, 1e-6);
}

}  // namespace
}  // namespace docent::modules
