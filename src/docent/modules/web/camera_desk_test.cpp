#include "docent/modules/web/camera_desk.h"

#include <gtest/gtest.h>

#include "docent/messages/conversions.h"
#include "docent/messages/topics.h"
#include "docent/pictures/jpeg/jpeg.h"
#include "docent/transport/virtual_time_bus.h"

namespace docent::modules {
namespace {

class CameraDeskTest : public testing::Test {
 protected:
  static sensor_msgs::CompressedImage picture(double time, int width = 16) {
    const pictures::Image image{width, 16, pictures::colors::kBlue};
    return {{to_message(Time{} + seconds(time)), "camera"}, "jpeg", pictures::encode_jpeg(image, 80)};
  }
  void robot_sees(double time, int width = 16) {
    robot_.publish(picture(time, width));
    hub_.run_until(hub_.now() + seconds(0.01));
  }
  void scene_sees(double time, int width = 16) {
    scene_.publish(picture(time, width));
    hub_.run_until(hub_.now() + seconds(0.01));
  }
  [[nodiscard]] std::string taken(const char* camera) const {
    return site_->get(std::string{"/camera/"} + camera + ".jpg").taken;
  }

  transport::VirtualTimeHub hub_;
  std::unique_ptr<transport::Bus> bus_ = hub_.connect("web");
  std::unique_ptr<transport::Bus> world_ = hub_.connect("world");
  transport::Publisher<sensor_msgs::CompressedImage> robot_ = world_->publisher(topics::kCamera);
  transport::Publisher<sensor_msgs::CompressedImage> scene_ = world_->publisher(topics::kSceneCamera);
  std::shared_ptr<telepresence::Site> site_ = std::make_shared<telepresence::Site>();
  CameraDesk desk_{*bus_, site_};
};

TEST_F(CameraDeskTest, HasNothingToShowAtFirst) {
  EXPECT_EQ(site_->get("/camera/robot.jpg").status, 204);
  EXPECT_EQ(site_->get("/camera/scene.jpg").status, 204);
}

TEST_F(CameraDeskTest, ShowsPairsOfTheSameMoment) {
  robot_sees(1.0);
  scene_sees(1.1);
  EXPECT_EQ(taken("robot"), "1.000");
  EXPECT_EQ(taken("scene"), "1.100");
  robot_sees(2.0);
  EXPECT_EQ(taken("robot"), "1.000") << "its pair is still to come";
  scene_sees(2.1);
  EXPECT_EQ(taken("robot"), "2.000");
  EXPECT_EQ(taken("scene"), "2.100");
  EXPECT_EQ(site_->get("/camera/robot.jpg").content_type, "image/jpeg");
}

TEST_F(CameraDeskTest, ShowsACameraThatIsAlone) {
  robot_sees(1.0);
  scene_sees(1.0);
  hub_.run_until(hub_.now() + seconds(5.0));
  robot_sees(6.0);
  EXPECT_EQ(taken("robot"), "6.000");
  EXPECT_EQ(taken("scene"), "1.000") << "the page says how old it is";
}

TEST_F(CameraDeskTest, ServesNothingThatIsNoPicture) {
  sensor_msgs::CompressedImage page;
  page.format = "jpeg";
  page.data = {'<', 's', 'c', 'r', 'i', 'p', 't', '>'};
  robot_.publish(page);
  hub_.run_until(hub_.now() + seconds(0.01));
  EXPECT_EQ(site_->get("/camera/robot.jpg").status, 204);
  EXPECT_NE(desk_.fault().find("camera/image/compressed: no JPEG"), std::string::npos) << desk_.fault();
  robot_sees(1.0);
  EXPECT_EQ(desk_.fault(), "");
}

sensor_msgs::Image raw_picture(double time, const std::string& encoding) {
  sensor_msgs::Image image;
  image.header = {to_message(Time{} + seconds(time)), "camera"};
  image.width = image.height = 16;
  image.encoding = encoding;
  image.step = 48;
  image.data.assign(16 * 48, 200);
  return image;
}

TEST_F(CameraDeskTest, CompressesWhatComesWithoutBeingCompressed) {
  const auto raw = world_->publisher(topics::kCameraImage);
  raw.publish(raw_picture(1.0, "rgb8"));
  hub_.run_until(hub_.now() + seconds(0.01));
  EXPECT_EQ(taken("robot"), "1.000");
  const auto shown = site_->get("/camera/robot.jpg");
  EXPECT_EQ(shown.content_type, "image/jpeg");
  raw.publish(raw_picture(1.05, "rgb8"));
  hub_.run_until(hub_.now() + seconds(0.1));
  EXPECT_EQ(taken("robot"), "1.000") << "not faster than eyes need";
  hub_.run_until(hub_.now() + seconds(0.2));
  raw.publish(raw_picture(1.3, "rgb8"));
  hub_.run_until(hub_.now() + seconds(0.3));
  EXPECT_EQ(taken("robot"), "1.300");
  robot_sees(1.6);
  raw.publish(raw_picture(1.7, "rgb8"));
  hub_.run_until(hub_.now() + seconds(0.01));
  EXPECT_EQ(taken("robot"), "1.600") << "the same camera, and compressed by its driver";
}

TEST_F(CameraDeskTest, SaysWhichPixelsItDoesNotRead) {
  world_->publisher(topics::kSceneCameraImage).publish(raw_picture(1.0, "bayer_rggb8"));
  hub_.run_until(hub_.now() + seconds(0.01));
  EXPECT_EQ(site_->get("/camera/scene.jpg").status, 204);
  EXPECT_EQ(desk_.fault(), "scene_camera/image/compressed: pixels of encoding 'bayer_rggb8' are not read");
}

}  // namespace
}  // namespace docent::modules
