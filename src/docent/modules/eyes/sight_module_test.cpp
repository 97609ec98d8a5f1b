#include "docent/modules/eyes/sight_module.h"

#include <cmath>

#include "docent/modules/shared/module_bench.h"
#include "docent/vision/depth/testing.h"

namespace docent::modules::sight_module_test {
namespace {

using vision::made_up_room::Scene;

/// A robot that stands before a scene, and its depth camera's driver.
class SightTest : public ModuleBench {
 protected:
  SightTest() : ModuleBench{"sight", make_sight} {
    EXPECT_TRUE(config.set("sight.enabled=true"));
    EXPECT_TRUE(config.set("sight.place.x=0.2"));
    EXPECT_TRUE(config.set("sight.place.y=0"));
    EXPECT_TRUE(config.set("sight.place.z=1"));
    EXPECT_TRUE(config.set("sight.place.tilt=-35"));
    keep(topics::kObstacleLines, lines_, count_);
  }
  [[nodiscard]] static sensor_msgs::Image image_of(const vision::DepthPicture& picture) {
    sensor_msgs::Image image;
    image.width = static_cast<std::uint32_t>(picture.columns);
    image.height = static_cast<std::uint32_t>(picture.rows);
    image.encoding = "16UC1";
    image.step = 2 * image.width;
    for (const float depth : picture.depth) {
      const auto mm = static_cast<std::uint16_t>(std::lround(1000.0F * depth));
      image.data.push_back(static_cast<std::uint8_t>(mm & 0xFFU));
      image.data.push_back(static_cast<std::uint8_t>(mm >> 8U));
    }
    return image;
  }
  void say_lens() {
    sensor_msgs::CameraInfo info;
    info.width = 320, info.height = 240;
    info.distortion_model = "plumb_bob";
    info.d = {0.0, 0.0, 0.0, 0.0, 0.0};
    info.k = {292.5, 0.0, 160.0, 0.0, 292.5, 120.0, 0.0, 0.0, 1.0};
    infos_.publish(info);
  }
  void say_odometry() {
    nav_msgs::Odometry odometry;
    odometry.header = {to_message(hub.now()), "odom"};
    odometry.pose.pose.orientation.w = 1.0;
    odometry_.publish(odometry);
  }
  /// For so long [s], at 5 Hz. @param delay  [s] of the pictures
  void look(const Scene& scene, double duration, double delay = 0.0) {
    for (double t = 0.0; t < duration; t += 0.2) {
      say_lens();
      for (int i = 0; i < 4; ++i) say_odometry(), run(0.05);
      sensor_msgs::Image image = image_of(vision::made_up_room::picture_of(scene, camera_, 0.0, rng_));
      image.header = {to_message(hub.now() - seconds(delay)), "depth_camera"};
      images_.publish(image);
    }
    run(0.3);
  }
  /// [m] ahead, of its ends.
  [[nodiscard]] double nearest_line() const {
    float least = 100.0F;
    for (const auto& line : lines_.lines) least = std::min({least, line.x1, line.x2});
    return static_cast<double>(least);
  }

  vision::DepthCamera camera_ = vision::made_up_room::front_camera();
  Rng rng_{7};
  transport::Publisher<sensor_msgs::Image> images_ = world->publisher(topics::kDepthImage);
  transport::Publisher<sensor_msgs::CameraInfo> infos_ = world->publisher(topics::kDepthInfo);
  transport::Publisher<nav_msgs::Odometry> odometry_ = world->publisher(topics::kOdometry);
  docent_msgs::ObstacleLines lines_;
  int count_ = 0;
};

const Scene kLowBox{.boxes = {{{1.5, -0.2, 0.0}, {1.8, 0.2, 0.08}}}};

TEST_F(SightTest, TellsOfALowThingAndOfFreeFloor) {
  start();
  look(kLowBox, 1.0);
  EXPECT_EQ(module->health().reason, "");
  EXPECT_EQ(lines_.header.frame_id, "base_link");
  EXPECT_NEAR(nearest_line(), 1.5, 0.1);
  look({}, 1.5);
  EXPECT_TRUE(lines_.lines.empty()) << "it was taken away";
}

TEST_F(SightTest, TellsWhereTheFloorEnds) {
  start();
  look({.floor_until = 1.6}, 1.0);
  EXPECT_NEAR(nearest_line(), 1.6, 0.15);
}

TEST_F(SightTest, GoesOnTellingWhenItsCameraHasFailed) {
  start();
  look(kLowBox, 1.0);
  for (int i = 0; i < 60; ++i) say_odometry(), run(0.05);
  EXPECT_EQ(module->health().state, "degraded");
  EXPECT_NE(module->health().reason.find("no picture any more"), std::string::npos);
  const int before = count_;
  for (int i = 0; i < 20; ++i) say_odometry(), run(0.05);
  EXPECT_GE(count_ - before, 9);
  EXPECT_NEAR(nearest_line(), 1.5, 0.1);
}

TEST_F(SightTest, NamesWhatIsWrongWithItsPictures) {
  start();
  look({}, 1.0);
  const Scene black{.boxes = {{{0.3, -2.0, 0.0}, {0.35, 2.0, 2.0}}}};  // nearer than it measures
  look(black, 1.0);
  EXPECT_NE(module->health().reason.find("nothing is on its pictures"), std::string::npos) << module->health().reason;
  look({}, 1.0);
  EXPECT_EQ(module->health().reason, "");
  look({}, 1.0, 0.9);
  EXPECT_NE(module->health().reason.find("late"), std::string::npos) << module->health().reason;
}

TEST_F(SightTest, NamesAFrozenCamera) {
  start();
  sensor_msgs::Image image = image_of(vision::made_up_room::picture_of({}, camera_, 0.0, rng_));
  for (int i = 0; i < 10; ++i) {
    say_lens(), say_odometry();
    image.header = {to_message(hub.now()), "depth_camera"};
    images_.publish(image);
    run(0.2);
  }
  EXPECT_NE(module->health().reason.find("frozen"), std::string::npos) << module->health().reason;
}

TEST_F(SightTest, NamesACameraThatIsTurnedOver) {
  ASSERT_TRUE(config.set("sight.place.roll=180"));
  start();
  look(kLowBox, 2.0);
  EXPECT_NE(module->health().reason.find("sees no floor"), std::string::npos) << module->health().reason;
}

TEST_F(SightTest, SaysNothingWhereThereIsNoCamera) {
  ASSERT_TRUE(config.set("sight.enabled=false"));
  start();
  look(kLowBox, 1.0);
  EXPECT_EQ(count_, 0);
  EXPECT_EQ(module->health().state, "ready");
}

TEST_F(SightTest, RefusesACameraThatLooksUp) {
  ASSERT_TRUE(config.set("sight.place.tilt=10"));
  EXPECT_FALSE(make_sight({*world, museum, config, state, 1, true}));
}

}  // namespace
}  // namespace docent::modules::sight_module_test
