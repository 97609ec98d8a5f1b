#include "docent/modules/eyes/camera_messages.h"

#include <gtest/gtest.h>

#include <cstring>

#include "docent/modules/eyes/eye_places.h"

namespace docent::modules::camera_messages_test {
namespace {

sensor_msgs::CameraInfo info_of(std::uint32_t width, std::uint32_t height) {
  sensor_msgs::CameraInfo info;
  info.width = width, info.height = height;
  info.distortion_model = "plumb_bob";
  info.k = {0.9 * width, 0.0, 0.5 * width, 0.0, 0.9 * width, 0.5 * height, 0.0, 0.0, 1.0};
  return info;
}

TEST(CameraMessages, ReadsBothModels) {
  sensor_msgs::CameraInfo info = info_of(640, 480);
  info.d = {-0.2, 0.05, 0.001, -0.001, 0.0};
  const auto pinhole = lens_of(info);
  ASSERT_TRUE(pinhole);
  EXPECT_EQ(pinhole->kind, vision::LensParams::Kind::pinhole);
  EXPECT_DOUBLE_EQ(pinhole->bend[1], 0.05);
  info.distortion_model = "equidistant";
  info.d = {0.1, 0.2, 0.3, 0.4};
  const auto fisheye = lens_of(info);
  ASSERT_TRUE(fisheye);
  EXPECT_EQ(fisheye->kind, vision::LensParams::Kind::fisheye);
  EXPECT_DOUBLE_EQ(fisheye->bend[3], 0.4);
}

TEST(CameraMessages, RefusesWhatItDoesNotRead) {
  const auto complaint = [](auto change) {
    sensor_msgs::CameraInfo info = info_of(640, 480);
    change(info);
    const auto lens = lens_of(info);
    return lens ? std::string{} : lens.error().message;
  };
  EXPECT_NE(complaint([](auto& i) { i.k = {}; }).find("calibrate"), std::string::npos);
  EXPECT_NE(complaint([](auto& i) { i.distortion_model = "rational_polynomial"; }).find("rational"), std::string::npos);
  EXPECT_NE(complaint([](auto& i) { i.d = {1.0, 2.0}; }).find("5 coefficients"), std::string::npos);
  EXPECT_NE(complaint([](auto& i) { i.binning_x = 2; }).find("binning"), std::string::npos);
  EXPECT_NE(complaint([](auto& i) { i.roi.width = 100; }).find("part"), std::string::npos);
  EXPECT_EQ(complaint([](auto& i) { i.roi.width = 640; }), "");
  sensor_msgs::CameraInfo bent = info_of(640, 480);
  bent.d = {0.1, 0.0, 0.0, 0.0, 0.0};
  EXPECT_FALSE(depth_camera_of(bent, {}));
}

TEST(CameraMessages, DecimatesWidePictures) {
  const auto camera = depth_camera_of(info_of(848, 480), {});
  ASSERT_TRUE(camera) << camera.error().message;
  EXPECT_EQ(camera->columns, 282);
  EXPECT_EQ(camera->rows, 160);
  EXPECT_NEAR(camera->focal, 0.9 * 848 / 3, 1e-9);
  sensor_msgs::Image image;
  image.width = 848, image.height = 480, image.encoding = "32FC1", image.step = 4 * 848;
  for (std::uint32_t i = 0; i < 848 * 480; ++i) {
    const float depth = static_cast<float>(i / 848) * 0.01F;
    std::uint8_t bytes[4];
    std::memcpy(bytes, &depth, 4);
    image.data.insert(image.data.end(), bytes, bytes + 4);
  }
  const auto picture = depth_picture_of(image, *camera);
  ASSERT_TRUE(picture) << picture.error().message;
  EXPECT_FLOAT_EQ(picture->depth[picture->index(5, 10)], 0.31F);  // row 3 * 10 + 1
  image.encoding = "rgb8";
  EXPECT_FALSE(depth_picture_of(image, *camera));
}

TEST(CameraMessages, ReadsEitherByteOrder) {
  const auto camera = depth_camera_of(info_of(32, 16), {});
  ASSERT_TRUE(camera) << camera.error().message;
  sensor_msgs::Image image;
  image.width = 32, image.height = 16, image.encoding = "16UC1", image.step = 64, image.is_bigendian = 1;
  for (int i = 0; i < 32 * 16; ++i) image.data.insert(image.data.end(), {0x04, 0x4C});
  const auto picture = depth_picture_of(image, *camera);
  ASSERT_TRUE(picture) << picture.error().message;
  EXPECT_FLOAT_EQ(picture->depth[0], 1.1F);
  image.width = 20;
  EXPECT_FALSE(depth_picture_of(image, *camera)) << "another size";
}

TEST(EyePlace, IsThatOfItsMount) {
  for (const EyePlace& place : {EyePlace{0.1, 0.02, 1.25, 0.0, 90.0, 0.0}, EyePlace{0.1, 0.0, 1.2, 140.0, 89.3, -40.0},
                                EyePlace{0.16, -0.03, 1.05, 3.0, -30.0, 2.0}}) {
    const vision::CameraMount mount = place.camera_mount(), again = place_of(mount).camera_mount();
    EXPECT_TRUE(mount.position.isApprox(again.position));
    EXPECT_TRUE(mount.robot_from_camera.isApprox(again.robot_from_camera, 1e-9)) << place.tilt;
  }
}

}  // namespace
}  // namespace docent::modules::camera_messages_test
