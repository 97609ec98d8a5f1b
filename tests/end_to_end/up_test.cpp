#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <thread>

#include "docent/transport/dds_bus.h"
#include "program.h"

namespace docent::up_test {
namespace {

using namespace std::chrono_literals;

constexpr int kDomain = 44;
constexpr const char* kPort = "18044";
const std::string kMuseum = std::string{DOCENT_SOURCES} + "/museums/bonn";

/// `docent up` without a simulator: the modules lack their sensors, which they must say and survive.
std::vector<std::string> up_arguments(const std::string& state) {
  return {"up", "--museum", kMuseum, "--state", state, "--domain", std::to_string(kDomain), "--port", kPort};
}

/// Listens to docent/health.
class Listener {
 public:
  Listener() {
    auto bus = transport::DdsBus::create({kDomain, "", {}});
    if (!bus) std::abort();
    bus_ = std::move(*bus);
    bus_->subscribe<docent_msgs::Health>(topics::kHealth, [this](const docent_msgs::Health& health) {
      const std::scoped_lock lock{mutex_};
      last_[health.module] = health;
      ++count_[health.module];
    });
    thread_ = std::jthread{[this](const std::stop_token& stop) { bus_->run(stop); }};
  }
  [[nodiscard]] int pid_of(const std::string& module) {
    const std::scoped_lock lock{mutex_};
    return last_[module].pid;
  }
  [[nodiscard]] int count(const std::string& module) {
    const std::scoped_lock lock{mutex_};
    return count_[module];
  }

 private:
  std::unique_ptr<transport::DdsBus> bus_;
  std::mutex mutex_;
  std::map<std::string, docent_msgs::Health> last_;
  std::map<std::string, int> count_;
  std::jthread thread_;
};

TEST(Up, AKilledModuleIsBackAndAStoppedOneGoesOn) {
  const TemporaryFolder state;
  Listener listener;
  Program up{up_arguments(state.path())};
  ASSERT_TRUE(eventually([&] { return listener.count("plan") > 2 && listener.count("map") > 2; }, 20s)) << up.output();

  const int plan = listener.pid_of("plan");
  kill(plan, SIGKILL);
  const auto killed = std::chrono::steady_clock::now();
  ASSERT_TRUE(eventually([&] { return listener.pid_of("plan") != plan; }, 10s)) << up.output();
  EXPECT_LT(std::chrono::steady_clock::now() - killed, 6s);
  EXPECT_TRUE(up.prints("error plan: ended (signal 9), starts again in 0.2 s", 2s)) << up.output();

  const int map = listener.pid_of("map");
  kill(map, SIGSTOP);
  EXPECT_TRUE(up.prints("error map: not responding", 8s)) << up.output();
  const int before = listener.count("map");
  kill(map, SIGCONT);
  EXPECT_TRUE(eventually([&] { return listener.count("map") > before + 1; }, 5s)) << up.output();
  EXPECT_EQ(listener.pid_of("map"), map) << "who wakes in time goes on";

  const auto children = up.children();
  EXPECT_GE(children.size(), 2U);
  up.signal(SIGTERM);
  EXPECT_EQ(up.wait(10s), 0) << up.output();
  for (const pid_t child : children) EXPECT_FALSE(is_running(child));
}

TEST(Up, ChildrenDieWithASupervisorThatIsKilled) {
  const TemporaryFolder state;
  Program up{up_arguments(state.path())};
  ASSERT_TRUE(eventually([&] { return up.children().size() >= 2; }, 10s)) << up.output();
  const auto children = up.children();
  up.signal(SIGKILL);
  EXPECT_EQ(up.wait(5s), 128 + SIGKILL);
  EXPECT_TRUE(eventually([&] { return std::none_of(children.begin(), children.end(), is_running); }, 3s));
}

TEST(Up, OneRobotAFolder) {
  const TemporaryFolder state;
  Program up{up_arguments(state.path())};
  ASSERT_TRUE(up.prints("open http", 10s)) << up.output();
  auto arguments = up_arguments(state.path());
  arguments.insert(arguments.end(), {"--port", "18045"});
  arguments.erase(std::find(arguments.begin(), arguments.end(), "--port"), arguments.end() - 2);
  const auto second = run_program(arguments);
  EXPECT_EQ(second.code, 1);
  EXPECT_EQ(second.output, "docent: --state " + state.path().string() + ": another `docent up` works there\n");
}

TEST(Up, WhatAModuleRefusesStopsItAll) {
  const TemporaryFolder folder;
  auto arguments = up_arguments(folder.path() / "state");
  const std::string config = folder.write("robot.yaml", "map: {}\nplan:\n  speed_of_thought: 3\n");
  arguments.insert(arguments.end(), {"--robot", config});
  const auto result = run_program(arguments);
  EXPECT_EQ(result.code, 2);
  EXPECT_NE(result.output.find("docent: " + config + ":3: "), std::string::npos) << result.output;
}

}  // namespace
}  // namespace docent::up_test
