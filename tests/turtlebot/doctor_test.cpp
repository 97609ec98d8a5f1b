#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "docent/museum/museum.h"
#include "docent/transport/dds_bus.h"
#include "program.h"
#include "turtlebot_wire.h"

// docent doctor beside a TurtleBot 4 that stands: all is fine, and what is taken away is named.

namespace docent::turtlebot {
namespace {

constexpr int kDomain = 88;
const std::string kRobot = std::string{DOCENT_SOURCES} + "/robots/turtlebot-4.yaml";
const std::string kMuseum = std::string{DOCENT_SOURCES} + "/museums/bonn";

class Doctor : public ::testing::Test {
 protected:
  void begin(bool offers_actions = true) {
    auto museum = museum::load_museum(kMuseum);
    ASSERT_TRUE(museum);
    Settings settings;
    settings.world = museum->map;
    settings.map_from_dock = {7.0, 1.5, Angle::degrees(-90.0)};
    settings.map_from_robot = settings.map_from_dock;
    WireSettings wire;
    wire.domain = kDomain;
    wire.offers_actions = offers_actions;
    const std::string body = run_program({"config", "body", "--robot", kRobot}).output;
    if (body.find("topic:") == std::string::npos) wire.scan_topic = "scan_front";
    robot.emplace(settings, wire);
  }
  /// @returns the finding of that name
  nlohmann::json examine(const std::string& name) {
    const Finished done =
        run_program({"doctor", "--json", "--listen", "4", "--robot", kRobot, "--museum", kMuseum, "--domain",
                     std::to_string(kDomain), "--port", "18088", "--state", state.path() / "state"});
    code = done.code;
    const auto from = done.output.find("{\n");
    if (from == std::string::npos) return done.output;
    page = nlohmann::json::parse(done.output.substr(from, done.output.rfind('}') + 1 - from));
    for (const auto& finding : page["findings"])
      if (finding["name"] == name) return finding;
    return page;
  }

  TemporaryFolder state;
  std::optional<Turtlebot> robot;
  nlohmann::json page;
  int code = -1;
};

TEST_F(Doctor, ATurtlebotInItsDockIsFine) {
  begin();
  const auto scanner = examine("scanner front");
  EXPECT_EQ(code, 0) << page.dump(1);
  EXPECT_EQ(scanner["verdict"], "fine") << scanner.dump();
  EXPECT_NEAR(scanner["figures"]["rate_hz"].get<double>(), 7.5, 1.5);
  EXPECT_EQ(examine("dock, undock")["verdict"], "fine");
  EXPECT_EQ(examine("hazard_detection")["verdict"], "fine");
}

TEST_F(Doctor, WhatIsMissingIsNamed) {
  begin(false);
  robot->silence_hazards();
  std::this_thread::sleep_for(std::chrono::seconds{1});
  EXPECT_EQ(examine("hazard_detection")["verdict"], "wrong");
  EXPECT_EQ(code, 1);
  EXPECT_EQ(examine("dock, undock")["text"], "the base offers no action /dock or no action /undock");
}

TEST_F(Doctor, WithoutABaseAllOfItIsMissing) {
  EXPECT_EQ(examine("odom")["text"], "nobody publishes it; a transform odom -> base_link on /tf would do");
  EXPECT_EQ(code, 1);
  EXPECT_EQ(examine("museum")["verdict"], "fine");
}

}  // namespace
}  // namespace docent::turtlebot
