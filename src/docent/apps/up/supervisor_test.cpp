#include "docent/apps/up/supervisor.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <thread>

namespace docent::apps::up_command {
namespace {

using namespace std::chrono_literals;

ChildSpec shell(std::string name, std::string script) {
  return {std::move(name), {"/bin/sh", "-c", std::move(script)}, 0, false};
}

struct Lines {
  std::vector<std::string> lines;
  Supervisor::Log log() {
    return [this](Supervisor::From, const std::string& name, const std::string& line) {
      lines.push_back(name + ": " + line);
    };
  }
  [[nodiscard]] int count(const std::string& part) const {
    return static_cast<int>(
        std::count_if(lines.begin(), lines.end(), [&](const auto& l) { return l.find(part) != std::string::npos; }));
  }
};

bool step_until(Supervisor& supervisor, const std::function<bool()>& done) {
  const auto end = Supervisor::Clock::now() + 5s;
  while (!done() && Supervisor::Clock::now() < end) {
    supervisor.step();
    std::this_thread::sleep_for(2ms);
  }
  return done();
}

bool is_alive(pid_t pid) { return kill(pid, 0) == 0; }

TEST(Supervisor, RestartsWhoEndsAndPassesOnWhatTheySay) {
  Lines lines;
  Supervisor supervisor{{shell("a", "echo hello; exit 3")}, lines.log()};
  EXPECT_TRUE(step_until(supervisor, [&] { return lines.count("a: hello") == 3; }));
  EXPECT_GE(lines.count("a: ended (exit code 3), starts again in 0.2 s"), 1);
  EXPECT_GE(lines.count("a: ended (exit code 3), starts again in 0.4 s"), 1);
  EXPECT_FALSE(supervisor.fatal().has_value());
  EXPECT_GE(supervisor.status()[0].restarts, 2);
}

TEST(Supervisor, WhoShallBeginAnewDoesSoAtOnceWithAnotherCommand) {
  Lines lines;
  const auto saying = [](const std::string& word) {
    return shell("a", "trap 'echo bye; exit 0' TERM; echo " + word + "; while :; do sleep 0.01; done");
  };
  Supervisor supervisor{{saying("one"), shell("b", "echo b; exec sleep 100")}, lines.log()};
  ASSERT_TRUE(step_until(supervisor, [&] { return lines.count("one") == 1 && lines.count("b: b") == 1; }));
  const pid_t other = supervisor.status()[1].pid;
  const auto begun = Supervisor::Clock::now();
  supervisor.replace({saying("two"), shell("b", "")}, "b");
  ASSERT_TRUE(step_until(supervisor, [&] { return lines.count("two") == 1; }));
  EXPECT_LT(Supervisor::Clock::now() - begun, 2s);
  EXPECT_EQ(lines.count("bye"), 1) << "it ended in order";
  EXPECT_EQ(supervisor.status()[1].pid, other) << "the other was left alone";
  EXPECT_TRUE(is_alive(other));
}

TEST(Supervisor, OthersTakeThePlaceOfThoseWhoAreNotNeeded) {
  Lines lines;
  Supervisor supervisor{{shell("a", "echo a; exec sleep 100"), shell("b", "echo b; exec sleep 100")}, lines.log()};
  ASSERT_TRUE(step_until(supervisor, [&] { return lines.count("a: a") == 1 && lines.count("b: b") == 1; }));
  const pid_t gone = supervisor.status()[1].pid;
  supervisor.replace({shell("a", "echo again; exec sleep 100"), shell("c", "echo c; exec sleep 100")}, "");
  ASSERT_TRUE(step_until(supervisor, [&] {
    return lines.count("a: again") == 1 && lines.count("c: c") == 1 && supervisor.status().size() == 2;
  }));
  EXPECT_EQ(supervisor.status()[1].name, "c");
  EXPECT_FALSE(is_alive(gone));
  supervisor.replace({shell("a", "echo third; exec sleep 100"), shell("b", "echo b; exec sleep 100")}, "");
  EXPECT_TRUE(step_until(supervisor, [&] { return lines.count("b: b") == 2 && supervisor.status().size() == 2; }))
      << "who was not needed may come back";
}

TEST(Supervisor, WhoDoesNotEndWhenToldIsKilledAndBeginsAnew) {
  Lines lines;
  Supervisor supervisor{{shell("a", "trap '' TERM; echo up; while :; do sleep 0.01; done")}, lines.log()};
  ASSERT_TRUE(step_until(supervisor, [&] { return lines.count("up") == 1; }));
  supervisor.replace({shell("a", "echo again; exec sleep 100")}, "");
  EXPECT_TRUE(step_until(supervisor, [&] { return lines.count("again") == 1; }));
}

TEST(Supervisor, AKilledProcessIsBackSoon) {
  Lines lines;
  Supervisor supervisor{{shell("a", "echo up; exec sleep 100")}, lines.log()};
  ASSERT_TRUE(step_until(supervisor, [&] { return lines.count("up") == 1; }));
  kill(supervisor.status()[0].pid, SIGKILL);
  const auto killed = Supervisor::Clock::now();
  ASSERT_TRUE(step_until(supervisor, [&] { return lines.count("up") == 2; }));
  EXPECT_LT(Supervisor::Clock::now() - killed, 1s);
  EXPECT_EQ(lines.count("a: ended (signal 9), starts again in 0.2 s"), 1);
}

TEST(Supervisor, ARefusedConfigurationStopsEverything) {
  Lines lines;
  Supervisor supervisor{{shell("good", "exec sleep 100"), shell("bad", "echo 'robot.yaml:3: no'; exit 2")},
                        lines.log()};
  ASSERT_TRUE(step_until(supervisor, [&] { return supervisor.fatal().has_value(); }));
  EXPECT_EQ(*supervisor.fatal(), "robot.yaml:3: no");
  supervisor.stop();
  EXPECT_EQ(supervisor.status()[0].pid, 0);
}

TEST(Supervisor, WhoDoesNotRespondIsKilledAndStartedAgain) {
  Lines lines;
  auto spec = shell("a", "echo up; exec sleep 100");
  spec.has_health = true;
  LifecycleParams params;
  params.silent_s = 0.2;
  params.hung_s = 0.5;
  Supervisor supervisor{{spec}, lines.log(), params};
  ASSERT_TRUE(step_until(supervisor, [&] { return lines.count("up") == 1; }));
  const pid_t pid = supervisor.status()[0].pid;
  supervisor.heard("a", pid + 1, "ready", "");
  EXPECT_EQ(supervisor.status()[0].text, "starting") << "the health of another process";
  supervisor.heard("a", pid, "ready", "");
  EXPECT_EQ(supervisor.status()[0].text, "ready");
  kill(pid, SIGSTOP);
  ASSERT_TRUE(step_until(supervisor, [&] { return lines.count("up") == 2; }));
  EXPECT_EQ(lines.count("a: does not respond: killed"), 1);
  EXPECT_FALSE(is_alive(pid));
}

TEST(Supervisor, StopTakesAlsoTheStubbornTheStoppedAndTheirChildren) {
  Lines lines;
  Supervisor supervisor{{shell("stubborn", "trap '' TERM; sleep 100 & echo $!; while :; do wait; done"),
                         shell("stopped", "trap 'echo bye; exit 0' TERM; echo up; while :; do sleep 0.05; done")},
                        lines.log()};
  ASSERT_TRUE(step_until(supervisor, [&] { return lines.lines.size() == 2; }));
  pid_t grandchild = 0;
  for (const auto& line : lines.lines) {
    if (line.starts_with("stubborn: ")) grandchild = std::stoi(line.substr(10));
  }
  ASSERT_GT(grandchild, 0);
  kill(supervisor.status()[1].pid, SIGSTOP);
  supervisor.stop(0.5);
  for (const auto& status : supervisor.status()) EXPECT_EQ(status.pid, 0) << status.name;
  EXPECT_EQ(lines.count("stopped: bye"), 1) << "it was woken to end in order";
  std::this_thread::sleep_for(50ms);
  // The process that adopts orphans may not have collected it yet.
  std::ifstream state{"/proc/" + std::to_string(grandchild) + "/stat"};
  std::string number, name, letter;
  EXPECT_TRUE(!(state >> number >> name >> letter) || letter == "Z") << letter;
}

TEST(Supervisor, ItsChildrenDieWithIt) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  const pid_t host = fork();
  if (host == 0) {
    Supervisor supervisor{{shell("a", "echo $$; exec sleep 100")},
                          [&](Supervisor::From, const std::string&, const std::string& line) {
                            static_cast<void>(!write(ends[1], line.c_str(), line.size()));
                          }};
    for (;;) {
      supervisor.step();
      usleep(1000);
    }
  }
  char text[32] = {};
  ASSERT_GT(read(ends[0], text, sizeof text - 1), 0);
  const pid_t child = std::atoi(text);
  ASSERT_TRUE(is_alive(child));
  kill(host, SIGKILL);
  waitpid(host, nullptr, 0);
  std::ifstream state;
  const auto end = Supervisor::Clock::now() + 3s;
  bool is_gone = false;
  while (!is_gone && Supervisor::Clock::now() < end) {
    std::this_thread::sleep_for(10ms);
    std::ifstream stat{"/proc/" + std::to_string(child) + "/stat"};
    std::string number, name, letter;
    is_gone = !(stat >> number >> name >> letter) || letter == "Z";
  }
  EXPECT_TRUE(is_gone);
}

}  // namespace
}  // namespace docent::apps::up_command
