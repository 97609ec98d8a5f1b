#include "docent/modules/eyes/capture_module.h"

#include <gtest/gtest.h>

#include <thread>

#include "docent/base/files.h"
#include "docent/messages/dock_topics.h"
#include "docent/modules/shared/module_bench.h"
#include "docent/pictures/jpeg/jpeg.h"
#include "docent/vision/capture/fed_video_for_test.h"
#include "docent/vision/lens/lens_file.h"

namespace docent::modules::capture_module_test {
namespace {

using vision::fed_video::FedVideo;

std::vector<std::uint8_t> frame_of(std::uint8_t shade) { return std::vector<std::uint8_t>(2 * 64 * 48, shade); }

/// A robot at whose computer a camera is fed.
class CaptureTest : public ModuleBench {
 protected:
  CaptureTest() : ModuleBench{"capture", make_capture} {
    vision::LensParams lens;
    lens.columns = 64, lens.rows = 48, lens.focal_x = lens.focal_y = 50.0;
    lens.centre_x = 31.5, lens.centre_y = 23.5;
    EXPECT_TRUE(write_file_atomically(state / "lens.yaml", vision::lens_to_yaml(lens)));
    for (const std::string& setting :
         {std::string{"enabled=true"}, std::string{"device=/dev/video7"}, std::string{"format=yuyv"},
          std::string{"width=64"}, std::string{"height=48"}, "lens=" + (state / "lens.yaml").string()})
      EXPECT_TRUE(config.set("capture." + setting)) << setting;
    keep(topics::kFrontImage, image_, images_);
    keep(topics::kFrontInfo, info_, infos_);
    keep(topics::kFrontPicture, file_, files_);
  }
  ~CaptureTest() override { module.reset(), bus_.reset(); }

  void open() {
    auto calls = std::make_unique<FedVideo>();
    camera_ = calls.get();
    bus_ = hub.connect("capture");
    auto made = make_capture_with({*bus_, museum, config, state, 1, true}, std::move(calls));
    ASSERT_TRUE(made) << made.error().message;
    module = std::move(*made);
  }
  /// Until something holds, for the camera has a thread of its own.
  template <class Condition>
  bool comes(const Condition& holds) {
    for (int i = 0; i < 1000 && !holds(); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds{4});
      run(0.01);
    }
    return holds();
  }
  [[nodiscard]] bool says(const std::string& word) const {
    return module->health().reason.find(word) != std::string::npos;
  }

  FedVideo* camera_ = nullptr;
  std::unique_ptr<transport::Bus> bus_;
  sensor_msgs::Image image_;
  sensor_msgs::CameraInfo info_;
  sensor_msgs::CompressedImage file_;
  int images_ = 0, infos_ = 0, files_ = 0;
};

TEST_F(CaptureTest, PublishesFramesWithTheirLensAndWhenTheyWereTaken) {
  open();
  run(1.0);
  camera_->feed(frame_of(7), 60);
  ASSERT_TRUE(comes([&] { return images_ == 1; }));
  EXPECT_EQ(image_.encoding, "yuv422_yuy2");
  EXPECT_EQ(image_.data, frame_of(7));
  EXPECT_EQ(infos_, 1);
  EXPECT_DOUBLE_EQ(info_.k[0], 50.0);
  EXPECT_NEAR(to_seconds(hub.now() - from_message(image_.header.stamp)), 0.06, 0.03);
  EXPECT_EQ(module->health().reason, "");
}

TEST_F(CaptureTest, NamesACameraThatIsUnpluggedAndGoesOnWithItLater) {
  open();
  camera_->feed(frame_of(7));
  ASSERT_TRUE(comes([&] { return images_ == 1; }));
  camera_->unplug();
  EXPECT_TRUE(comes([&] { return says("/dev/video7 is gone") || says("cannot be opened"); }));
  EXPECT_EQ(module->health().state, "degraded");
  camera_->plug();
  EXPECT_TRUE(comes([&] {
    camera_->feed(frame_of(8));
    return images_ >= 2;
  }));
  EXPECT_EQ(module->health().reason, "");
}

TEST_F(CaptureTest, NamesLateFramesAndHalfOnes) {
  open();
  camera_->feed(frame_of(7), 900);
  EXPECT_TRUE(comes([&] { return says("900 ms old"); }));
  EXPECT_TRUE(comes([&] {
    camera_->feed(std::vector<std::uint8_t>(1000));
    return says("half");
  }));
  EXPECT_EQ(images_, 1);
}

TEST_F(CaptureTest, HandsOnFilesAsTheyAre) {
  ASSERT_TRUE(config.set("capture.format=mjpeg"));
  open();
  camera_->formats = V4L2_PIX_FMT_MJPEG;
  const auto jpeg = pictures::encode_jpeg(pictures::Image{64, 48}, 80);
  EXPECT_TRUE(comes([&] {
    camera_->feed(jpeg);
    return files_ > 0;
  }));
  EXPECT_EQ(file_.data, jpeg);
  EXPECT_EQ(images_, 0);
}

TEST_F(CaptureTest, RefusesALensOfOtherPicturesAndNone) {
  const auto refusal = [&] {
    const auto made = make_capture_with({*world, museum, config, state, 1, true}, std::make_unique<FedVideo>());
    return made ? std::string{} : made.error().message;
  };
  ASSERT_TRUE(config.set("capture.width=128"));
  EXPECT_NE(refusal().find("another size"), std::string::npos);
  config = robot::RobotConfig{};
  ASSERT_TRUE(config.set("capture.enabled=true"));
  EXPECT_NE(refusal().find("docent calibrate-camera"), std::string::npos) << refusal();
}

}  // namespace
}  // namespace docent::modules::capture_module_test
