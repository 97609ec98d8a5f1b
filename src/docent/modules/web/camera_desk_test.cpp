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

}  // namespace
}  // namespace docent::modules
