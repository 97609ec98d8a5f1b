#include "docent/interaction/kiosk/button_device.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <linux/input.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace docent::interaction {
namespace {

class ButtonDeviceTest : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  static ButtonParams at(const std::filesystem::path& path) {
    ButtonParams params;
    params.device = path.string();
    return params;
  }
  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("docent-buttons-" + std::to_string(::getpid()));
};

TEST_F(ButtonDeviceTest, ReadsWhatAPipeSaysUntilItEnds) {
  const auto pipe = folder_ / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  auto device = ButtonDevice::open(at(pipe));
  ASSERT_TRUE(device) << device.error().message;
  EXPECT_EQ(device->read(Duration{}), std::string{});
  const int end = ::open(pipe.c_str(), O_WRONLY);
  ASSERT_EQ(::write(end, "press", 5), 5);
  EXPECT_EQ(device->read(seconds(1)), std::string{"press"});
  EXPECT_EQ(device->read(Duration{}), std::string{});
  ::close(end);
  const auto gone = device->read(seconds(1));
  ASSERT_FALSE(gone);
  EXPECT_NE(gone.error().message.find("is gone"), std::string::npos) << gone.error().message;
}

TEST_F(ButtonDeviceTest, WhatIsNoDeviceIsNamed) {
  const auto why = [](const ButtonParams& params) {
    const auto device = ButtonDevice::open(params);
    return device ? std::string{} : device.error().message;
  };
  std::ofstream{folder_ / "file"} << "bytes";
  EXPECT_EQ(why(at(folder_ / "file")), (folder_ / "file").string() + ": is no device");
  EXPECT_NE(why(at(folder_ / "nothing")).find("No such file"), std::string::npos);
  EXPECT_NE(why(at("/dev/null")).find("is no evdev device"), std::string::npos);
  ButtonParams params;
  params.name = "buttons that nobody sells";
  EXPECT_EQ(why(params), "no input device is called 'buttons that nobody sells'");
}

TEST(ButtonParams, KeysAreThoseOfLinux) {
  using Buttons = std::array<std::uint16_t, kButtons>;
  EXPECT_EQ(button_codes({"KEY_1", "KEY_2", "KEY_3", "KEY_4"}, "")->buttons, (Buttons{KEY_1, KEY_2, KEY_3, KEY_4}));
  EXPECT_EQ(button_codes({"BTN_TRIGGER", "BTN_THUMB", "KEY_A", "KEY_F1"}, "")->buttons,
            (Buttons{BTN_TRIGGER, BTN_THUMB, KEY_A, KEY_F1}));
  EXPECT_EQ(button_codes({"KEY_1", "KEY_2", "KEY_3", "KEY_4"}, "KEY_ESC")->stop, KEY_ESC);
  EXPECT_FALSE(button_codes({"KEY_1", "KEY_2", "KEY_3", "KEY_4"}, "")->stop);
  ButtonParams params;
  EXPECT_TRUE(params.validate());
  EXPECT_FALSE(params.is_configured());
  const auto fault = [&params] { return params.validate() ? std::string{} : params.validate().error().message; };
  params.keys = {"KEY_1", "KEY_2", "KEY_3", "RED"};
  EXPECT_EQ(fault(), "buttons.keys: RED is no key");
  params.keys = {"KEY_1", "KEY_2", "KEY_3", "KEY_1"};
  EXPECT_EQ(fault(), "buttons.keys: KEY_1 stands twice");
  params.keys = {"KEY_1"};
  EXPECT_EQ(fault(), "buttons.keys must name four keys");
  params = {};
  params.stop_key = "KEY_2";
  EXPECT_EQ(fault(), "buttons.stop_key: KEY_2 stands twice");
  params.stop_key = "STOP";
  EXPECT_EQ(fault(), "buttons.stop_key: STOP is no key");
  params = {};
  params.debounce = 2;
  EXPECT_EQ(fault(), "buttons.debounce must be 0..1 s");
  params = {};
  params.retry = 0;
  EXPECT_EQ(fault(), "buttons.retry must be > 0 s");
}

}  // namespace
}  // namespace docent::interaction
