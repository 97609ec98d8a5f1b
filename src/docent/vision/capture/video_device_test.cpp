#include "docent/vision/capture/video_device.h"

#include <gtest/gtest.h>

#include "docent/vision/capture/fed_video_for_test.h"

namespace docent::vision {
namespace {

using fed_video::FedVideo;

VideoParams params_of(VideoFormat format) { return {"/dev/video7", 64, 48, 10.0, format}; }

std::vector<std::uint8_t> rows_of(std::uint8_t shade, std::size_t size = 2 * 64 * 48) {
  return std::vector<std::uint8_t>(size, shade);
}

std::string refusal(FedVideo& camera, const VideoParams& params) {
  const auto device = VideoDevice::open(camera, params);
  return device ? "" : device.error().message;
}

TEST(VideoDevice, ReadsTheNewestFrameAndItsAge) {
  FedVideo camera;
  {
    auto device = VideoDevice::open(camera, params_of(VideoFormat::yuyv));
    ASSERT_TRUE(device) << device.error().message;
    EXPECT_FALSE(*device->read(1)) << "none yet";
    camera.feed(rows_of(1), 300);
    camera.feed(rows_of(2), 40);
    const auto frame = device->read(5);
    ASSERT_TRUE(frame && *frame);
    EXPECT_EQ((*frame)->bytes, rows_of(2)) << "the older one is of no use";
    EXPECT_EQ((*frame)->step, 128U);
    EXPECT_EQ((*frame)->age, std::chrono::milliseconds{40});
    for (std::uint8_t i = 3; i < 30; ++i) {  // all buffers go round
      camera.feed(rows_of(i));
      const auto next = device->read(5);
      ASSERT_TRUE(next && *next);
      EXPECT_EQ((*next)->bytes.front(), i);
    }
  }
  EXPECT_EQ(camera.opened, 0);
  EXPECT_EQ(camera.mapped, 0);
}

TEST(VideoDevice, LeavesOutHalfAFrame) {
  FedVideo camera;
  camera.padding = 12;
  auto raw = VideoDevice::open(camera, params_of(VideoFormat::yuyv));
  ASSERT_TRUE(raw);
  camera.feed(rows_of(1, 140 * 48 / 2));
  EXPECT_FALSE(*raw->read(2));
  camera.feed(rows_of(1, 140 * 48), 10, true);
  EXPECT_FALSE(*raw->read(2)) << "the driver says that it is damaged";
  camera.feed(rows_of(1, 140 * 48));
  EXPECT_TRUE(*raw->read(2));
  EXPECT_EQ(raw->halves(), 2U);
  FedVideo other;
  other.formats = V4L2_PIX_FMT_MJPEG;
  auto files = VideoDevice::open(other, params_of(VideoFormat::mjpeg));
  ASSERT_TRUE(files);
  other.feed({0xFF, 0xD8, 1, 2, 3, 4});
  EXPECT_FALSE(*files->read(2)) << "it has no end";
  other.feed({0xFF, 0xD8, 1, 2, 0xFF, 0xD9, 0, 0});
  ASSERT_TRUE(*files->read(2)) << "zeros behind its end";
  other.feed({});
  EXPECT_FALSE(*files->read(2));
  EXPECT_EQ(files->halves(), 2U);
}

TEST(VideoDevice, SaysThatItWasUnplugged) {
  FedVideo camera;
  auto device = VideoDevice::open(camera, params_of(VideoFormat::yuyv));
  ASSERT_TRUE(device);
  camera.unplug();
  const auto read = device->read(1);
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().message.find("/dev/video7 is gone"), std::string::npos) << read.error().message;
  EXPECT_NE(refusal(camera, params_of(VideoFormat::yuyv)).find("cannot be opened"), std::string::npos);
}

TEST(VideoDevice, RefusesWhatIsNotAskedFor) {
  FedVideo camera;
  EXPECT_NE(refusal(camera, params_of(VideoFormat::mjpeg)).find("no MJPEG"), std::string::npos);
  VideoParams large = params_of(VideoFormat::yuyv);
  large.width = 128;
  EXPECT_NE(refusal(camera, large).find("64 x 48"), std::string::npos);
  camera.capabilities = V4L2_CAP_VIDEO_OUTPUT;
  EXPECT_NE(refusal(camera, params_of(VideoFormat::yuyv)).find("no pictures"), std::string::npos);
  EXPECT_EQ(camera.opened, 0);
  EXPECT_EQ(camera.mapped, 0);
  EXPECT_FALSE((VideoParams{"", 64, 48, 10.0, VideoFormat::yuyv}).validate());
}

}  // namespace
}  // namespace docent::vision
