#include "docent/modules/drive/create3_hazards.h"

#include <gtest/gtest.h>

#include "docent/transport/create3_support.h"
#include "docent/transport/virtual_time_bus.h"

namespace docent::modules {
namespace {

using irobot_create_msgs::HazardDetection;

class Create3HazardsTest : public ::testing::Test {
 protected:
  Create3HazardsTest() {
    ears->subscribe<docent_msgs::Tactile>(topics::kTactile, [this](const auto& tactile) { rings.push_back(tactile); });
    ears->subscribe<docent_msgs::ObstacleLines>(topics::kObstacleLines,
                                                [this](const auto& seen) { lines.push_back(seen); });
  }
  void say(std::uint8_t type, const std::string& frame) {
    irobot_create_msgs::HazardDetectionVector message;
    if (!frame.empty()) message.detections.push_back({{{}, frame}, type});
    hazards.publish(message);
    run(0.001);
  }
  void run(double duration) { hub.run_until(hub.now() + seconds(duration)); }

  transport::VirtualTimeHub hub;
  std::unique_ptr<transport::Bus> bus = hub.connect("robot");
  std::unique_ptr<transport::Bus> base = hub.connect("base");
  std::unique_ptr<transport::Bus> ears = hub.connect("avoid");
  transport::Publisher<irobot_create_msgs::HazardDetectionVector> hazards = base->publisher(topics::kHazards);
  Create3Hazards adapter{*bus, 0.18};
  std::vector<docent_msgs::Tactile> rings;
  std::vector<docent_msgs::ObstacleLines> lines;
};

TEST_F(Create3HazardsTest, ATouchIsToldAtOnceAndTheRestAtTenHertz) {
  for (int i = 0; i < 60; ++i) {
    say(0, "");
    run(1.0 / 60.0 - 0.001);
  }
  EXPECT_GE(rings.size(), 8U);
  EXPECT_LE(rings.size(), 11U) << "sixty a second would be for nobody";
  EXPECT_EQ(lines.size(), rings.size()) << "a source of lines must not fall silent";
  const std::size_t before = rings.size();
  say(HazardDetection::kBump, "bump_front_left");
  ASSERT_EQ(rings.size(), before + 1);
  EXPECT_EQ(rings.back().segments.at(2), 1);
  EXPECT_EQ(rings.back().segments.at(10), 0);
  EXPECT_EQ(rings.back().scan, before + 1) << "it counts, so that a frozen base is told";
  say(0, "");
  ASSERT_EQ(rings.size(), before + 2) << "so is the end of a touch";
}

TEST_F(Create3HazardsTest, ASilentBaseIsASilentRingAndIsNamed) {
  EXPECT_EQ(adapter.complaint(), "no hazard_detection of the base yet");
  say(0, "");
  EXPECT_EQ(adapter.complaint(), "");
  const std::size_t before = rings.size();
  run(1.5);
  EXPECT_EQ(rings.size(), before);
  EXPECT_EQ(adapter.complaint(), "no fresh hazard_detection from the base");
}

TEST_F(Create3HazardsTest, AnEdgeIsALineThatStaysInTheRoom) {
  say(HazardDetection::kCliff, "cliff_front_right");
  ASSERT_FALSE(lines.empty());
  ASSERT_EQ(lines.back().lines.size(), 1U);
  EXPECT_GT(lines.back().lines[0].x1, 0.1F);
  nav_msgs::Odometry odometry;
  odometry.pose.pose.position.x = -1.0;
  base->publisher(topics::kOdometry).publish(odometry);
  run(0.2);
  say(0, "");
  ASSERT_EQ(lines.back().lines.size(), 1U);
  EXPECT_GT(lines.back().lines[0].x1, 1.1F) << "the robot has backed off by a metre";
}

TEST_F(Create3HazardsTest, WhoLiftsTheRobotStopsIt) {
  say(HazardDetection::kWheelDrop, "wheel_drop_left");
  EXPECT_EQ(adapter.complaint(), "somebody has lifted the robot, or a wheel hangs in the air");
  EXPECT_EQ(rings.back().segments.front(), 255);
}

}  // namespace
}  // namespace docent::modules
