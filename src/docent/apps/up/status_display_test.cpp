#include "docent/apps/up/status_display.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace docent::apps::up_command {
namespace {

using namespace std::chrono_literals;

class Screen {
 public:
  StatusDisplay display{false, [this](const std::string& text) { shown_ += text; }, StatusDisplay::Clock::time_point{}};
  void show(const std::string& plan, const std::string& map, std::chrono::seconds at) {
    display.show({{"plan", plan, 1, 0}, {"map", map, 2, 0}}, StatusDisplay::Clock::time_point{} + at);
  }
  [[nodiscard]] auto lines() const { return std::count(shown_.begin(), shown_.end(), '\n'); }
  [[nodiscard]] bool says(const std::string& text) const { return shown_.find(text) != std::string::npos; }
  [[nodiscard]] const std::string& text() const { return shown_; }

 private:
  std::string shown_;
};

TEST(StatusDisplay, AHealthyStartIsOneLine) {
  Screen screen;
  screen.show("starting", "starting", 0s);
  screen.show("degraded: no odometry", "starting", 1s);
  screen.show("ready", "degraded: waits", 2s);
  screen.show("ready", "ready", 8s);
  screen.show("ready", "ready", 9s);
  EXPECT_EQ(screen.lines(), 1) << screen.text();
  EXPECT_TRUE(screen.says(" info up: all 2 modules are ready")) << screen.text();
}

TEST(StatusDisplay, WhatIsStillMissingAfterTheStartIsSaid) {
  Screen screen;
  screen.show("ready", "degraded: no scan for 3 s", 2s);
  EXPECT_EQ(screen.lines(), 0) << screen.text();
  screen.show("ready", "degraded: no scan for 31 s", 31s);
  screen.show("ready", "degraded: no scan for 32 s", 32s);
  EXPECT_EQ(screen.lines(), 1) << screen.text();
  EXPECT_TRUE(screen.says(" warning map: degraded: no scan for 31 s")) << screen.text();
}

TEST(StatusDisplay, FaultsDuringTheStartAreSaidAtOnce) {
  Screen screen;
  screen.show("not responding for 3 s", "starting", 3s);
  EXPECT_TRUE(screen.says(" error plan: not responding for 3 s")) << screen.text();
}

TEST(StatusDisplay, ChangesAfterTheStartAreSaidWithTheirLevel) {
  Screen screen;
  screen.show("ready", "ready", 5s);
  screen.show("degraded: no odometry", "ready", 6s);
  screen.show("ready", "ready", 7s);
  EXPECT_TRUE(screen.says(" warning plan: degraded: no odometry")) << screen.text();
  EXPECT_TRUE(screen.says(" info plan: ready")) << screen.text();
}

TEST(StatusDisplay, WhatAModuleThatIsReadySaysOfItselfIsNoFaultAndSaidOnce) {
  Screen screen;
  screen.show("ready: slow until it knows", "ready", 5s);
  EXPECT_TRUE(screen.says(" info up: all 2 modules are ready")) << screen.text();
  EXPECT_TRUE(screen.says(" info plan: ready: slow until it knows")) << screen.text();
  screen.show("ready", "ready", 6s);
  screen.show("ready: slow until it knows", "ready", 7s);
  screen.show("ready", "ready", 8s);
  EXPECT_EQ(screen.lines(), 2) << screen.text();
  screen.show("degraded: no odometry", "ready", 9s);
  screen.show("ready: slow until it knows", "ready", 10s);
  EXPECT_EQ(screen.lines(), 4) << "it is well again: " << screen.text();
}

TEST(StatusDisplay, WhatAModuleWritesKeepsItsOwnTimeOrGetsOne) {
  Screen screen;
  screen.display.log_output("map", "2026-11-24 10:15:02.123 error map: no disk");
  screen.display.log_output("map", "terminate called");
  EXPECT_TRUE(screen.text().starts_with("2026-11-24 10:15:02.123 error map: no disk\n")) << screen.text();
  EXPECT_TRUE(screen.says(" warning map: terminate called")) << screen.text();
}

}  // namespace
}  // namespace docent::apps::up_command
