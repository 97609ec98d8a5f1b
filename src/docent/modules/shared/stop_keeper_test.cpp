#include "docent/modules/shared/stop_keeper.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdio>
#include <memory>
#include <optional>
#include <system_error>
#include <thread>

#include "docent/base/files.h"
#include "docent/transport/dds_bus.h"
#include "docent/transport/virtual_time_bus.h"

namespace docent::modules {
namespace {

/// A robot of three processes that keep the button.
class StopKeeperTest : public testing::Test {
 protected:
  StopKeeperTest() { std::filesystem::create_directories(state_); }
  ~StopKeeperTest() override {
    for (std::size_t i = 0; i < kNames.size(); ++i) kill(i);
    std::filesystem::remove_all(state_);
  }
  void start(std::size_t i) {
    kill(i);
    buses_.at(i) = hub_.connect(kNames.at(i));
    const ModuleContext context{*buses_[i], museum_, config_, state_, 1, true};
    keepers_.at(i) = std::make_unique<StopKeeper>(context, kNames[i], [this] { ++changes_; });
  }
  void start_all() {
    for (std::size_t i = 0; i < kNames.size(); ++i) start(i);
  }
  void kill(std::size_t i) {
    keepers_.at(i).reset();
    buses_.at(i).reset();
  }
  void run(double duration) { hub_.run_until(hub_.now() + seconds(duration)); }
  void press() {
    keepers_[2]->button().press("ada");
    keepers_[2]->tell();
  }
  [[nodiscard]] bool all_hold() const {
    return std::all_of(keepers_.begin(), keepers_.end(), [](const auto& keeper) { return !keeper || keeper->holds(); });
  }
  [[nodiscard]] std::filesystem::path file_of(const char* name) const { return state_ / "stops" / name; }

  static constexpr std::array<const char*, 3> kNames{"avoid", "robot", "web/one"};
  const std::filesystem::path state_{testing::TempDir() + "/stops-" + std::to_string(::getpid())};
  transport::VirtualTimeHub hub_;
  museum::Museum museum_;
  robot::RobotConfig config_;
  std::array<std::unique_ptr<transport::Bus>, 3> buses_;
  std::array<std::unique_ptr<StopKeeper>, 3> keepers_;
  int changes_ = 0;
};

TEST_F(StopKeeperTest, ARobotThatStartsIsHeldForTwoSecondsAndThenFree) {
  start_all();
  run(1.5);
  EXPECT_TRUE(all_hold());
  EXPECT_EQ(keepers_[0]->health().state, "starting");
  run(1.0);
  for (const auto& keeper : keepers_) EXPECT_FALSE(keeper->holds());
  EXPECT_EQ(changes_, 3) << "each says so once";
  EXPECT_EQ(keepers_[0]->health().reason, "");
}

TEST_F(StopKeeperTest, APressReachesAllAtOnceAndOutlivesKillsWithoutTheirFiles) {
  start_all();
  run(3.0);
  press();
  run(0.01);
  EXPECT_TRUE(all_hold());
  EXPECT_TRUE(keepers_[2]->button().is_confirmed(1, hub_.now()));
  for (const auto& [first, second] : {std::pair{0, 1}, {1, 2}, {2, 0}}) {
    kill(static_cast<std::size_t>(first));
    kill(static_cast<std::size_t>(second));
    std::error_code still_written;
    std::filesystem::remove_all(state_ / "stops", still_written);  // the disk has lost all
    start(static_cast<std::size_t>(first));
    start(static_cast<std::size_t>(second));
    for (int i = 0; i < 50; ++i) {
      EXPECT_TRUE(all_hold());
      run(0.1);
    }
  }
}

TEST_F(StopKeeperTest, OutlivesThePowerByItsFiles) {
  start_all();
  run(3.0);
  press();
  run(0.5);
  for (std::size_t i = 0; i < kNames.size(); ++i) kill(i);
  for (const char* name : {"avoid", "robot", "web"})
    EXPECT_EQ(read_file(file_of(name)).value(), "1 stopped ada\n") << name;
  std::filesystem::remove(file_of("web"));
  start_all();
  run(5.0);
  EXPECT_TRUE(all_hold());
  ASSERT_TRUE(keepers_[1]->button().release("grace", 1));
  keepers_[1]->tell();
  run(0.1);
  for (const auto& keeper : keepers_) EXPECT_FALSE(keeper->holds());
  for (std::size_t i = 0; i < kNames.size(); ++i) kill(i);
  start_all();
  run(5.0);
  for (const auto& keeper : keepers_) EXPECT_FALSE(keeper->holds()) << "released for good";
}

TEST_F(StopKeeperTest, AStopThatNobodyCanReadAnyMoreIsAStop) {
  std::filesystem::create_directories(state_ / "stops");
  ASSERT_TRUE(write_file_atomically(file_of("robot"), "57 stop"));
  start_all();
  run(5.0);
  EXPECT_TRUE(all_hold());
  const ModuleHealth health = keepers_[1]->health();
  EXPECT_EQ(health.state, "degraded");
  EXPECT_NE(health.reason.find("stops/robot"), std::string::npos) << health.reason;
  ASSERT_TRUE(keepers_[2]->button().release("ada", 0)) << "an operator can look and release it";
  keepers_[2]->tell();
  run(0.1);
  EXPECT_FALSE(keepers_[1]->holds());
}

TEST_F(StopKeeperTest, SaysThatItsFileCannotBeWritten) {
  ASSERT_TRUE(write_file_atomically(state_ / "stops", "in the way of the folder"));
  start_all();
  run(3.0);
  press();
  run(0.1);
  EXPECT_TRUE(all_hold());
  for (int i = 0; i < 1000 && keepers_[0]->health().reason.empty(); ++i) ::usleep(5000);
  EXPECT_NE(keepers_[0]->health().reason.find("stops/avoid"), std::string::npos) << keepers_[0]->health().reason;
}

TEST(StopView, OfWhatKeepersSayTheLatestHolds) {
  StopView view;
  docent_msgs::Stop stop;
  EXPECT_FALSE(view.see(stop));
  stop.number = 4;
  stop.is_stopped = true;
  EXPECT_TRUE(view.see(stop));
  stop.number = 3;
  stop.is_stopped = false;
  EXPECT_TRUE(view.see(stop)) << "an older word of one who has not heard yet";
  stop.number = 5;
  EXPECT_FALSE(view.see(stop));
}

/// One process of a robot over DDS.
class DdsKeeper {
 public:
  explicit DdsKeeper(const char* name) : bus_{std::move(*transport::DdsBus::create({84, "", {}}))} {
    keeper_ = std::make_unique<StopKeeper>(ModuleContext{*bus_, museum_, config_, "", 1}, name, [] {});
    bus_->every(std::chrono::milliseconds{1}, [this] {
      const auto& button = keeper_->button();
      is_confirmed_ = is_sure_ && button.is_confirmed(asked_, bus_->now());
      is_sure_ = button.is_sure(bus_->now());
    });
    thread_ = std::jthread{[this](const std::stop_token& stop) { bus_->run(stop); }};
  }
  DdsKeeper(const DdsKeeper&) = delete;
  DdsKeeper& operator=(const DdsKeeper&) = delete;
  ~DdsKeeper() { thread_ = {}; }
  /// Presses or releases, and waits until enough hold it. @returns [s] 9: they do not
  double order(bool presses) {
    const auto begun = std::chrono::steady_clock::now();
    const auto passed = [&] { return std::chrono::duration<double>{std::chrono::steady_clock::now() - begun}.count(); };
    is_confirmed_ = false;
    bus_->post([this, presses] {
      auto& button = keeper_->button();
      if (presses) button.press("ada");
      if (!presses) button.release("ada", button.state().number);
      asked_ = button.state().number;
      is_confirmed_ = false;
      keeper_->tell();
    });
    std::this_thread::sleep_for(std::chrono::milliseconds{2});
    while (!is_confirmed_ && passed() < 9.0) std::this_thread::sleep_for(std::chrono::milliseconds{1});
    return passed();
  }
  [[nodiscard]] bool is_sure() const { return is_sure_; }

 private:
  museum::Museum museum_;
  robot::RobotConfig config_;
  std::unique_ptr<transport::DdsBus> bus_;
  std::unique_ptr<StopKeeper> keeper_;
  std::uint64_t asked_ = 0;  ///< of the bus's thread
  std::atomic<bool> is_confirmed_ = false, is_sure_ = false;
  std::jthread thread_;
};

TEST(StopKeeperOverDds, IsConfirmedAtOnceThoughAllAnswerTogether) {
  DdsKeeper avoid{"avoid"}, robot{"robot"}, web{"web/one"};
  for (int i = 0; i < 500 && !(avoid.is_sure() && robot.is_sure() && web.is_sure()); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds{10});
  std::vector<double> waits;
  for (int i = 0; i < 20; ++i) waits.push_back(web.order(i % 2 == 0));
  std::sort(waits.begin(), waits.end());
  std::printf("confirmed after %.3f s in the median, %.3f s at most\n", waits[10], waits.back());
  EXPECT_LT(waits[10], 0.1);
}

}  // namespace
}  // namespace docent::modules
