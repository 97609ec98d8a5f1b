#include "docent/simulator/cameras.h"

#include <gtest/gtest.h>

#include "docent/pictures/jpeg/jpeg.h"
#include "docent/simulator/museum_bench.h"

namespace docent::simulator::cameras_test {
namespace {

SimulationOptions with_cameras(std::uint64_t seed = 1) {
  SimulationOptions made = options("busy", Pose2{5.0, 5.0, Angle{}}, seed);
  made.world.scene_camera = CameraPlace{{1.0, 1.0}, 2.8};
  made.cameras = CameraOptions{.rate = 2.0, .width = 80, .height = 60};
  return made;
}

struct Watch {
  std::vector<sensor_msgs::CompressedImage> robot, scene;
  explicit Watch(Bench& bench) {
    bench.robot_bus->subscribe<sensor_msgs::CompressedImage>(topics::kCamera,
                                                             [this](const auto& m) { robot.push_back(m); });
    bench.robot_bus->subscribe<sensor_msgs::CompressedImage>(topics::kSceneCamera,
                                                             [this](const auto& m) { scene.push_back(m); });
  }
};

TEST(Cameras, SendPicturesOfTheSameMomentAtTheirRate) {
  Bench bench{with_cameras()};
  const Watch watch{bench};
  bench.run(10.0);
  ASSERT_EQ(watch.robot.size(), 20U);
  ASSERT_EQ(watch.scene.size(), 20U);
  for (std::size_t i = 0; i < 20; ++i)
    EXPECT_EQ(from_message(watch.robot[i].header.stamp).nanoseconds,
              from_message(watch.scene[i].header.stamp).nanoseconds);
  const auto size = pictures::jpeg_size(watch.scene.back().data);
  ASSERT_TRUE(size) << size.error().message;
  EXPECT_EQ(size->width, 80);
  EXPECT_EQ(watch.robot.back().format, "jpeg");
}

TEST(Cameras, ChangeNothingElse) {
  SimulationOptions without = with_cameras();
  without.cameras.reset();
  Bench blind{std::move(without)};
  Bench seeing{with_cameras()};
  Bench again{with_cameras()};
  for (Bench* bench : {&blind, &seeing, &again}) bench->drive(0.3, 0.1, 10.0);
  EXPECT_EQ(blind.hash, seeing.hash);
  EXPECT_EQ(seeing.picture_hash, again.picture_hash);
  EXPECT_NE(seeing.picture_hash, blind.picture_hash);
}

/// Pixels of the robot's red drum.
int red_pixels(const sensor_msgs::CompressedImage& picture) {
  const auto image = pictures::decode_jpeg(picture.data);
  int count = 0;
  if (!image) return count;
  for (int y = 0; y < image->height(); ++y)
    for (int x = 0; x < image->width(); ++x) {
      const auto c = image->at(x, y);
      count += c.red > 110 && c.green < 60 && c.blue < 60 ? 1 : 0;
    }
  return count;
}

TEST(Cameras, TheMountTurnsTowardsTheRobot) {
  SimulationOptions alone = with_cameras();
  alone.crowd = "empty";
  Bench bench{std::move(alone)};
  const auto views = bench.robot_bus->publisher(topics::kSceneCameraView);
  const Watch watch{bench};
  const double tilt = -std::atan2(2.5, norm(Point2{4.0, 4.0}));
  views.publish({{to_message(bench.hub.now()), "map"}, 0.785, tilt, 0.5});
  bench.run(3.0);
  EXPECT_GT(red_pixels(watch.scene.back()), 50);
  views.publish({{to_message(bench.hub.now()), "map"}, 0.0, tilt, 0.3});
  bench.run(3.0);
  EXPECT_EQ(red_pixels(watch.scene.back()), 0) << "it looks elsewhere";
  EXPECT_EQ(red_pixels(watch.robot.back()), 0) << "the robot does not see itself";
}

TEST(Cameras, RefuseNonsense) {
  SimulationOptions wrong = with_cameras();
  wrong.cameras->rate = 0.0;
  EXPECT_FALSE(validate(wrong));
  wrong.cameras = CameraOptions{.quality = 0};
  EXPECT_FALSE(validate(wrong));
}

}  // namespace
}  // namespace docent::simulator::cameras_test
