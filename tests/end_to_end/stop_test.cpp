#include <gtest/gtest.h>
#include <signal.h>

#include <atomic>
#include <cmath>
#include <cstdio>
#include <optional>
#include <utility>
#include <vector>

#include "docent/modules/shared/stop_keeper.h"
#include "program.h"
#include "robot_watch.h"

namespace docent::stop_test {
namespace {

using namespace std::chrono_literals;

constexpr int kDomain = 47;
const std::string kMuseum = std::string{DOCENT_SOURCES} + "/museums/bonn";

/// A gateway's end of the stop button, in this process: what an operator presses there.
class Gateway {
 public:
  explicit Gateway(const std::string& name) : bus_{std::move(*transport::DdsBus::create({kDomain, "", {}}))} {
    keeper_ =
        std::make_unique<modules::StopKeeper>(modules::ModuleContext{*bus_, museum_, config_, "", 1}, name, [] {});
    bus_->every(std::chrono::milliseconds{5}, [this] { look(); });
    thread_ = std::jthread{[this](const std::stop_token& stop) { bus_->run(stop); }};
  }
  ~Gateway() { thread_ = {}; }
  Gateway(const Gateway&) = delete;
  Gateway& operator=(const Gateway&) = delete;

  void press() {
    bus_->post([this] {
      keeper_->button().press("ada");
      keeper_->tell();
    });
  }
  void release() {
    bus_->post([this] {
      keeper_->button().release("ada", keeper_->button().state().number);
      keeper_->tell();
    });
  }
  [[nodiscard]] bool has_confirmed(bool is_stopped) const { return is_confirmed_ && is_stopped_ == is_stopped; }
  [[nodiscard]] bool is_sure() const { return is_sure_; }

 private:
  void look() {
    const auto& button = keeper_->button();
    is_stopped_ = button.state().is_stopped;
    is_confirmed_ = button.is_confirmed(button.state().number, bus_->now());
    is_sure_ = button.is_sure(bus_->now());
  }

  museum::Museum museum_;
  robot::RobotConfig config_;
  std::unique_ptr<transport::DdsBus> bus_;
  std::unique_ptr<modules::StopKeeper> keeper_;
  std::atomic<bool> is_stopped_ = false, is_confirmed_ = false, is_sure_ = false;
  std::jthread thread_;
};

/// A robot of processes that has a tour to give, and a gateway beside its own.
class StopTest : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(eventually([&] { return watch_.look().localized; }, 60s)) << up_.output();
    gateway_.emplace("web/test");
    ASSERT_TRUE(eventually([&] { return gateway_->is_sure(); }, 10s));
  }
  /// Until it drives on one of its tours.
  [[nodiscard]] bool drives() {
    return eventually(
        [&] {
          if (std::chrono::steady_clock::now() - asked_ > 20s) {
            asked_ = std::chrono::steady_clock::now();
            watch_.ask_for("exhibit", next_++ % 2 == 0 ? "particle-trap" : "zuse");
          }
          return std::abs(watch_.look().truth.linear) > 0.3;
        },
        120s);
  }
  [[nodiscard]] bool stands() {
    return eventually([&] { return std::abs(watch_.look().truth.linear) < 0.005; }, 3s);
  }
  void kill_one(const std::string& who) {
    if (who == "gateway") {
      gateway_.reset();
    } else {
      kill(watch_.look().health[who].health.pid, SIGKILL);
    }
  }
  /// [m] that it drives while two die, twice, and for four seconds after.
  double way_while_dying(const std::string& first, const std::string& second) {
    const double before = watch_.look().truth.distance_m;
    for (int round = 0; round < 2; ++round) {
      kill_one(first);
      std::this_thread::sleep_for(round == 0 ? 50ms : 600ms);
      kill_one(second);
      std::this_thread::sleep_for(4s);
      if (!gateway_) gateway_.emplace("web/test");
      EXPECT_TRUE(eventually([&] { return gateway_->has_confirmed(true); }, 10s)) << "the stop is lost";
    }
    return watch_.look().truth.distance_m - before;
  }

  const TemporaryFolder folder_;
  RobotWatch watch_{kDomain};
  Program up_{{"up", "--sim", "--museum", kMuseum, "--state", (folder_.path() / "state").string(), "--domain",
               std::to_string(kDomain), "--port", "18047", "--crowd", "quiet", "--requests-per-hour", "0",
               "--start=9,3.6,90"}};
  std::optional<Gateway> gateway_;
  std::chrono::steady_clock::time_point asked_{};
  int next_ = 0;
};

TEST_F(StopTest, AConfirmedStopOutlivesAnyTwoProcessesInAnyOrderTwice) {
  const std::vector<std::string> keepers{"gateway", "web", "avoid", "robot"};
  int trials = 0;
  for (const std::string& first : keepers) {
    for (const std::string& second : keepers) {
      if (first == second) continue;
      SCOPED_TRACE(first + ", then " + second);
      ASSERT_TRUE(drives()) << up_.output();
      const auto pressed = std::chrono::steady_clock::now();
      gateway_->press();
      ASSERT_TRUE(eventually([&] { return gateway_->has_confirmed(true); }, 3s));
      const double confirmed_s = std::chrono::duration<double>{std::chrono::steady_clock::now() - pressed}.count();
      ASSERT_TRUE(stands());
      const double way = way_while_dying(first, second);
      std::printf("%-8s %-8s confirmed after %.3f s, driven %.3f m\n", first.c_str(), second.c_str(), confirmed_s, way);
      EXPECT_LT(way, 0.005);
      gateway_->release();
      EXPECT_TRUE(eventually([&] { return gateway_->has_confirmed(false); }, 5s)) << "released everywhere";
      ++trials;
    }
  }
  EXPECT_EQ(trials, 12);
  EXPECT_TRUE(drives()) << "released, it goes on";
  EXPECT_EQ(watch_.report().contacts.all(), 0);
}

}  // namespace
}  // namespace docent::stop_test
