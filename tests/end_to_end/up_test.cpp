#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <signal.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <thread>

#include "docent/transport/dds_bus.h"
#include "program.h"

namespace docent {
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
    auto bus = DdsBus::create({kDomain, "", {}});
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
  std::unique_ptr<DdsBus> bus_;
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
  EXPECT_TRUE(up.prints("plan       ended (signal 9), starts again in 0.2 s", 2s)) << up.output();

  const int map = listener.pid_of("map");
  kill(map, SIGSTOP);
  EXPECT_TRUE(up.prints("map        not responding", 8s)) << up.output();
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
  ASSERT_TRUE(up.prints("plan ", 10s)) << up.output();
  auto arguments = up_arguments(state.path());
  arguments.insert(arguments.end(), {"--port", "18045"});
  arguments.erase(std::find(arguments.begin(), arguments.end(), "--port"), arguments.end() - 2);
  const auto second = run_program(arguments);
  EXPECT_EQ(second.code, 1);
  EXPECT_EQ(second.output, "docent: --state " + state.path().string() + ": another `docent up` works there\n");
}

struct BadInput {
  const char* name;
  std::vector<std::string> arguments;
  std::string says;  ///< in its one line
};

/// One clear line, a failing exit code, and nothing was started before.
void expect_refused(const BadInput& bad) {
  SCOPED_TRACE(bad.name);
  const auto result = run_program(bad.arguments);
  EXPECT_NE(result.code, 0);
  EXPECT_NE(result.code, -1) << "it went on";
  EXPECT_LT(result.code, 128) << "it crashed";
  EXPECT_TRUE(result.output.starts_with("docent: ")) << result.output;
  EXPECT_NE(result.output.find(bad.says), std::string::npos) << result.output;
  EXPECT_EQ(std::count(result.output.begin(), result.output.end(), '\n'), 1) << result.output;
}

TEST(Up, BadInputIsOneLineBeforeAnythingStarts) {
  const TemporaryFolder folder;
  const std::string state = folder.path() / "state";
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"up", "--domain", std::to_string(kDomain)});
    const auto has = [&](const char* option) { return std::find(more.begin(), more.end(), option) != more.end(); };
    if (!has("--museum")) more.insert(more.end(), {"--museum", kMuseum});
    if (!has("--state")) more.insert(more.end(), {"--state", state});
    if (!has("--port")) more.insert(more.end(), {"--port", kPort});
    return more;
  };
  const int taken = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  ASSERT_EQ(bind(taken, reinterpret_cast<sockaddr*>(&address), size), 0);
  ASSERT_EQ(listen(taken, 1), 0);
  ASSERT_EQ(getsockname(taken, reinterpret_cast<sockaddr*>(&address), &size), 0);
  const std::string port = std::to_string(ntohs(address.sin_port));

  const std::string key = folder.write("key.yaml", "plan: {}\nbody:\n  radius: 0.3\n  colour: red\n");
  const std::string section = folder.write("section.yaml", "plan: {}\nflying: {height: 3}\n");
  const std::string type = folder.write("type.yaml", "body:\n  radius: wide\n");
  const std::string syntax = folder.write("syntax.yaml", "body: [1, 2\nplan: }\n");
  const std::string list = folder.write("list.yaml", "- 1\n- 2\n");
  const std::string scenario = folder.write("scenario.yaml", "events:\n  - at: 3\n    dance: {}\n");
  const std::string file = folder.write("file", "");
  const std::string broken = folder.write("museum.yaml", "name: {en: \"Broken\"\nmap: 3\n");
  for (const auto& bad : std::vector<BadInput>{
           {"no museum", with({"--museum", "/nowhere"}), "/nowhere/museum.yaml"},
           {"broken museum", with({"--museum", folder.path()}), broken + ":"},
           {"no robot.yaml", with({"--robot", "/nowhere.yaml"}), "/nowhere.yaml"},
           {"unknown key", with({"--robot", key}), "key.yaml:4: "},
           {"unknown section", with({"--robot", section}), "section.yaml:2: unknown section 'flying'"},
           {"wrong type", with({"--robot", type}), "type.yaml:2: "},
           {"bad syntax", with({"--robot", syntax}), "syntax.yaml:"},
           {"no sections", with({"--robot", list}), "list.yaml:1: "},
           {"--set without value", with({"--set", "plan"}), "--set plan: expected section.key=value"},
           {"--set of a body that cannot be", with({"--set", "body.colour=red"}), "colour"},
           {"--set of an unknown section", with({"--set", "flying.height=3"}), "unknown section 'flying'"},
           {"port in use", with({"--port", port}), "Address already in use"},
           {"port out of range", with({"--port", "70000"}), "--port"},
           {"port of no number", with({"--port", "web"}), "--port"},
           {"domain out of range", with({"--domain", "231"}), "--domain"},
           {"state is a file", with({"--state", file}), "--state"},
           {"state cannot be made", with({"--state", "/proc/docent"}), "--state /proc/docent: "},
           {"recording into nothing", with({"--record", "/nowhere/a.mcap"}), "--record: no folder /nowhere"},
           {"start that is no pose", with({"--sim", "--start", "1,2"}), "--start"},
           {"start in the street", with({"--sim", "--start", "1000,1000,0"}), "outside the robot's area"},
           {"no scenario", with({"--sim", "--scenario", "/nowhere.yaml"}), "/nowhere.yaml"},
           {"unknown event", with({"--sim", "--scenario", scenario}), "scenario.yaml:3: "},
           {"unknown mode", with({"--mode", "upside-down"}), "--mode upside-down"},
           {"unknown crowd", with({"--crowd", "enormous"}), "--crowd"},
           {"unknown option", with({"--fly"}), "--fly"},
           {"unknown module", {"run", "nothing"}, "no module 'nothing'"},
           {"no command", {}, "subcommand"},
       }) {
    expect_refused(bad);
  }
  close(taken);
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
}  // namespace docent
