#include "docent/modules/eyes/things_module.h"

#include <array>
#include <cmath>
#include <filesystem>

#include "docent/messages/topics.h"
#include "docent/modules/shared/module_bench.h"
#include "docent/vision/depth/testing.h"

namespace docent::modules::things_module_test {
namespace {

/// A robot that stands before a red block on a grey floor, and the drivers of its two cameras.
class ThingsTest : public ModuleBench {
 protected:
  ThingsTest() : ModuleBench{"things", make_things} {
    for (const char* setting : {"sight.enabled=true", "things.enabled=true", "sight.place.x=0.2", "sight.place.y=0",
                                "sight.place.z=1", "sight.place.tilt=-35", "things.place.x=0.2", "things.place.y=0",
                                "things.place.z=1", "things.place.tilt=-35"})
      EXPECT_TRUE(config.set(setting));
    kept = state / "kept";
    std::filesystem::create_directories(kept);
    EXPECT_TRUE(config.set("things.keep=" + kept.string()));
    keep(topics::kSeenThings, seen, count);
  }
  static sensor_msgs::CameraInfo lens() {
    sensor_msgs::CameraInfo info;
    info.width = 320, info.height = 240;
    info.distortion_model = "plumb_bob";
    info.d = {0.0, 0.0, 0.0, 0.0, 0.0};
    info.k = {292.5, 0.0, 160.0, 0.0, 292.5, 120.0, 0.0, 0.0, 1.0};
    return info;
  }
  void stand() {
    docent_msgs::Belief belief;
    belief.header.stamp = to_message(hub.now());
    belief.localized = true;
    belief.odom_pose.orientation.w = 1.0;
    belief.hypotheses.resize(1);
    belief.hypotheses[0].x = 5.0;
    beliefs.publish(belief);
    nav_msgs::Odometry odometry;
    odometry.header = {to_message(hub.now()), "odom"};
    odometry.pose.pose.orientation.w = 1.0;
    odometries.publish(odometry);
    run(0.05);
  }
  /// For so many pictures of each camera.
  void look(int pictures) {
    const vision::made_up_room::Scene scene{.boxes = {{{1.5, -0.05, 0.0}, {1.6, 0.05, 0.14}}}};
    for (int i = 0; i < pictures; ++i) {
      depth_infos.publish(lens());
      front_infos.publish(lens());
      for (int k = 0; k < 4; ++k) stand();
      const auto depths = vision::made_up_room::picture_of(scene, camera, 0.0, rng);
      sensor_msgs::Image image;
      image.header = {to_message(hub.now()), "depth_camera"};
      image.width = 320, image.height = 240, image.encoding = "16UC1", image.step = 640;
      sensor_msgs::Image colours = image;
      colours.encoding = "rgb8", colours.step = 960;
      for (const float depth : depths.depth) {
        const auto mm = static_cast<std::uint16_t>(std::lround(1000.0F * depth));
        image.data.push_back(static_cast<std::uint8_t>(mm & 0xFFU));
        image.data.push_back(static_cast<std::uint8_t>(mm >> 8U));
        const auto pixel = colours.data.size() / 3;
        const auto column = static_cast<double>(pixel % 320), row = static_cast<double>(pixel / 320);
        const Eigen::Vector3d ray = camera.ray(column, row);
        const double away = ray.z() < 0.0 ? -1.0 / ray.z() : 1e9;
        const bool is_block = std::abs(static_cast<double>(depth) - away) > 0.04 && depth < 2.5F;
        for (const int level : is_block ? std::array{180, 30, 30} : std::array{130, 128, 124})
          colours.data.push_back(static_cast<std::uint8_t>(level + rng.integer(-2, 2)));
      }
      front_images.publish(colours);
      depth_images.publish(image);
    }
    run(0.6);
  }

  vision::DepthCamera camera = vision::made_up_room::front_camera();
  Rng rng{3};
  std::filesystem::path kept;
  transport::Publisher<docent_msgs::Belief> beliefs = world->publisher(topics::kBelief);
  transport::Publisher<nav_msgs::Odometry> odometries = world->publisher(topics::kOdometry);
  transport::Publisher<sensor_msgs::CameraInfo> depth_infos = world->publisher(topics::kDepthInfo);
  transport::Publisher<sensor_msgs::CameraInfo> front_infos = world->publisher(topics::kFrontInfo);
  transport::Publisher<sensor_msgs::Image> depth_images = world->publisher(topics::kDepthImage);
  transport::Publisher<sensor_msgs::Image> front_images = world->publisher(topics::kFrontImage);
  docent_msgs::SeenThings seen;
  int count = 0;
};

TEST_F(ThingsTest, TellsWhereAThingLiesAndKeepsPicturesToTeachBy) {
  start();
  look(5);
  ASSERT_EQ(seen.things.size(), 1U);
  EXPECT_NEAR(seen.things[0].x, 6.55, 0.04);
  EXPECT_NEAR(seen.things[0].y, 0.0, 0.03);
  EXPECT_EQ(seen.things[0].object, "");
  EXPECT_GE(seen.things[0].looks, 4U);
  const auto files = std::distance(std::filesystem::directory_iterator{kept}, std::filesystem::directory_iterator{});
  EXPECT_GE(files, 4);
  EXPECT_EQ(module->health().reason, "");
}

TEST_F(ThingsTest, KeepsNothingUnlessItIsAskedTo) {
  ASSERT_TRUE(config.set("things.keep=''"));
  start();
  look(3);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator{kept}, std::filesystem::directory_iterator{}), 0);
  EXPECT_NE(module->health().reason.find("learn-objects"), std::string::npos) << module->health().reason;
}

TEST_F(ThingsTest, NamesACameraThatIsSilentAndABookThatIsNone) {
  start();
  look(2);
  for (int i = 0; i < 60; ++i) stand();
  EXPECT_EQ(module->health().state, "degraded");
  EXPECT_NE(module->health().reason.find("camera"), std::string::npos);
  ASSERT_TRUE(config.set("things.book=/nowhere/objects.json"));
  const auto bus = hub.connect("another");
  EXPECT_FALSE(make_things({*bus, museum, config, state, 1, true}));
  ASSERT_TRUE(config.set("things.book="));
  ASSERT_TRUE(config.set("sight.enabled=false"));
  EXPECT_FALSE(make_things({*bus, museum, config, state, 1, true}));
}

}  // namespace
}  // namespace docent::modules::things_module_test
