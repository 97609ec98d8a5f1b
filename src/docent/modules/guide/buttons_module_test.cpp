#include "docent/modules/guide/buttons_module.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <linux/input.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <thread>

#include "docent/messages/conversions.h"
#include "docent/transport/virtual_time_bus.h"

namespace docent::modules {
namespace {

/// The module reads a pipe, into which the test writes what a keyboard would say.
class ButtonsModuleTest : public testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(state_);
    world_->subscribe<docent_msgs::Button>(topics::kButton, [this](const auto& m) { pressed_.push_back(m.number); });
    ASSERT_TRUE(config_.set("buttons.device=" + pipe_.string()));
    ASSERT_TRUE(config_.set("buttons.retry=0.02"));
  }
  void TearDown() override {
    module_.reset();
    unplug();
    std::filesystem::remove_all(state_);
  }
  void start(bool virtual_time = false) {
    auto module = make_buttons({*bus_, museum_, config_, state_, 1, virtual_time});
    ASSERT_TRUE(module) << module.error().message;
    module_ = std::move(*module);
  }
  void plug() {
    if (!std::filesystem::exists(pipe_)) {
      ASSERT_EQ(::mkfifo(pipe_.c_str(), 0600), 0);
    }
    for (int i = 0; i < 300 && (end_ = ::open(pipe_.c_str(), O_WRONLY | O_NONBLOCK)) < 0; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds{10});
    ASSERT_GE(end_, 0) << "the module does not open its device";
  }
  void unplug() {
    if (end_ >= 0) ::close(end_);
    end_ = -1;
    std::filesystem::remove(pipe_);
  }
  void say(int type, int code, int value) const {
    input_event event{};
    event.type = static_cast<std::uint16_t>(type);
    event.code = static_cast<std::uint16_t>(code);
    event.value = value;
    ASSERT_EQ(::write(end_, &event, sizeof event), static_cast<ssize_t>(sizeof event));
  }
  void press(int code) const {
    say(EV_KEY, code, 1);
    say(EV_SYN, SYN_REPORT, 0);
    say(EV_KEY, code, 0);
    say(EV_SYN, SYN_REPORT, 0);
  }
  /// Lets both clocks run until it is so.
  template <class Predicate>
  bool eventually(Predicate is_so) {
    for (int i = 0; i < 300; ++i) {
      hub_.run_until(hub_.now() + seconds(0.1));
      if (is_so()) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds{10});
    }
    return false;
  }
  [[nodiscard]] std::string reason() const { return module_->health().reason; }

  std::filesystem::path state_ =
      std::filesystem::temp_directory_path() / ("docent-buttons-" + std::to_string(::getpid()) + "-" +
                                                testing::UnitTest::GetInstance()->current_test_info()->name());
  std::filesystem::path pipe_ = state_ / "buttons";
  int end_ = -1;
  transport::VirtualTimeHub hub_;
  museum::Museum museum_;
  robot::RobotConfig config_;
  std::vector<int> pressed_;
  std::unique_ptr<transport::Bus> world_ = hub_.connect("world");
  std::unique_ptr<transport::Bus> bus_ = hub_.connect("buttons");
  std::unique_ptr<Module> module_;
};

TEST_F(ButtonsModuleTest, TheStopKeyStopsTheRobot) {
  ASSERT_EQ(::mkfifo(pipe_.c_str(), 0600), 0);
  ASSERT_TRUE(config_.set("buttons.stop_key=KEY_ESC"));
  std::string stopped_by;
  world_->subscribe<docent_msgs::Stop>(topics::kStop, [&](const auto& stop) {
    if (stop.is_stopped) stopped_by = stop.by;
  });
  start();
  plug();
  press(KEY_1);
  ASSERT_TRUE(eventually([this] { return pressed_ == std::vector<int>{1}; }));
  EXPECT_EQ(stopped_by, "");
  press(KEY_ESC);
  EXPECT_TRUE(eventually([&] { return stopped_by == "the stop key"; }));
  EXPECT_EQ(pressed_, std::vector<int>{1}) << "no button of the four";
  unplug();
  EXPECT_TRUE(eventually([this] { return reason().starts_with("no buttons and no stop key"); })) << reason();
}

TEST_F(ButtonsModuleTest, TellsEachPress) {
  ASSERT_EQ(::mkfifo(pipe_.c_str(), 0600), 0);
  start();
  plug();
  press(KEY_1);
  ASSERT_TRUE(eventually([this] { return pressed_.size() == 1; }));
  press(KEY_4);
  press(KEY_5);
  press(KEY_2);
  ASSERT_TRUE(eventually([this] { return pressed_.size() == 3; }));
  EXPECT_EQ(pressed_, (std::vector<int>{1, 4, 2}));
  EXPECT_EQ(module_->health().state, "ready");
}

TEST_F(ButtonsModuleTest, ADeviceMayComeAndGo) {
  start();
  ASSERT_TRUE(eventually([this] { return module_->health().state == "degraded"; }));
  EXPECT_NE(reason().find("no buttons: " + pipe_.string()), std::string::npos) << reason();
  for (int time = 1; time <= 3; ++time) {
    plug();
    ASSERT_TRUE(eventually([this] { return module_->health().state == "ready"; }));
    press(KEY_3);
    const char half[5] = {};  // pulled out in the middle of an event
    ASSERT_EQ(::write(end_, half, sizeof half), static_cast<ssize_t>(sizeof half));
    ASSERT_TRUE(eventually([&] { return pressed_.size() == static_cast<std::size_t>(time); }));
    unplug();
    ASSERT_TRUE(eventually([this] { return module_->health().state == "degraded"; }));
  }
  EXPECT_EQ(pressed_, (std::vector<int>{3, 3, 3}));
}

TEST_F(ButtonsModuleTest, NonsenseEndsNothing) {
  ASSERT_EQ(::mkfifo(pipe_.c_str(), 0600), 0);
  start();
  plug();
  const std::string noise(24 * 20, '\xA5');
  ASSERT_EQ(::write(end_, noise.data(), noise.size()), static_cast<ssize_t>(noise.size()));
  say(EV_KEY, KEY_1, 7);
  say(EV_SYN, SYN_DROPPED, 0);
  press(KEY_2);
  ASSERT_TRUE(eventually([this] { return !pressed_.empty(); }));
  EXPECT_EQ(pressed_, std::vector<int>{2});
}

TEST_F(ButtonsModuleTest, WithoutADeviceNothingIsMissed) {
  config_ = {};
  start();
  hub_.run_until(hub_.now() + seconds(1));
  EXPECT_EQ(module_->health().state, "ready");
}

TEST_F(ButtonsModuleTest, InVirtualTimeNothingIsRead) {
  ASSERT_EQ(::mkfifo(pipe_.c_str(), 0600), 0);
  start(true);
  hub_.run_until(hub_.now() + seconds(1));
  EXPECT_LT(::open(pipe_.c_str(), O_WRONLY | O_NONBLOCK), 0) << "somebody has opened it";
  EXPECT_EQ(module_->health().state, "ready");
}

TEST_F(ButtonsModuleTest, NonsenseInTheConfigurationIsNamed) {
  ASSERT_TRUE(config_.set("buttons.keys=[KEY_1, KEY_2, KEY_3, RED]"));
  const auto module = make_buttons({*bus_, museum_, config_, state_, 1, false});
  ASSERT_FALSE(module);
  EXPECT_NE(module.error().message.find("RED is no key"), std::string::npos) << module.error().message;
}

}  // namespace
}  // namespace docent::modules
