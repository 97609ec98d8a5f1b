#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iostream>
#include <sstream>

#include "docent/museum/museum.h"
#include "program.h"
#include "quick_museum.h"
#include "robot_watch.h"
#include "turtlebot_wire.h"

// docent up with robots/turtlebot-4.yaml beside a TurtleBot 4 by its own topics: no node of our own stands between
// them.

namespace docent::turtlebot {
namespace {

using namespace std::chrono_literals;

constexpr int kDomain = 87;
const std::string kRobot = std::string{DOCENT_SOURCES} + "/robots/turtlebot-4.yaml";

/// Bonn with little to say, and its charger where a TurtleBot docks: the place before its dock, looking at it.
std::string museum_for_docking(const std::filesystem::path& folder) {
  const std::string museum = with_short_texts(std::string{DOCENT_SOURCES} + "/museums/bonn", folder);
  std::ifstream in{museum + "/museum.yaml"};
  std::stringstream text;
  text << in.rdbuf();
  std::string yaml = text.str();
  const std::string was = "charger: {x: 7.0, y: 1.5, heading: 90}";
  const auto at = yaml.find(was);
  if (at == std::string::npos) std::abort();
  yaml.replace(at, was.size(), "charger: {x: 7.0, y: 2.0, heading: -90}");
  std::ofstream{museum + "/museum.yaml"} << yaml;
  return museum;
}

class TurtlebotTest : public ::testing::Test {
 protected:
  void begin(const WireSettings& wire, const Pose2& map_from_robot, bool is_docked, double battery = 0.9) {
    watch.emplace(kDomain);  // makes the domain, on loopback
    Settings settings;
    settings.world = value_of(museum::load_museum(museum)).map;
    settings.map_from_dock = {7.0, 1.5, Angle::degrees(-90.0)};
    settings.map_from_robot = map_from_robot;
    settings.begins_docked = is_docked;
    robot.emplace(settings, wire);
    robot->with_body([&](Body& body) { body.battery = battery; });
    // A first word of where it stands: how a robot finds itself is tested elsewhere.
    up.emplace(
        std::vector<std::string>{"up", "--museum", museum, "--robot", kRobot, "--state", state.path() / "state",
                                 "--domain", std::to_string(kDomain), "--port", "18087", "--mode", "open", "--set",
                                 wire.stamped_commands ? "body.stamped_commands=true" : "body.stamped_commands=false"});
  }
  template <class T>
  static T value_of(Result<T> result) {
    if (!result) std::abort();
    return std::move(*result);
  }
  [[nodiscard]] Pose2 place() {
    return robot->with_body([](Body& body) { return body.map_from_robot(); });
  }
  [[nodiscard]] double speed() {
    return robot->with_body([](Body& body) { return body.linear(); });
  }
  [[nodiscard]] bool is_docked() {
    return robot->with_body([](Body& body) { return body.is_docked(); });
  }
  [[nodiscard]] std::string told() {
    std::ostringstream text;
    const auto snapshot = watch->look();
    for (const auto& [module, heard] : snapshot.health)
      if (heard.health.state != "ready")
        text << module << " " << heard.health.state << " " << heard.health.reason << "; ";
    const Pose2 at = place();
    text << "mission " << snapshot.mission.phase << ", goal " << snapshot.goal.state << ", at " << at.x << " " << at.y
         << " " << at.theta.degrees() << (is_docked() ? ", docked" : "") << ", goals " << robot->goals().first << "+"
         << robot->goals().second;
    return text.str();
  }

  TemporaryFolder state;
  std::string museum = museum_for_docking(state.path() / "museum");
  std::optional<RobotWatch> watch;
  std::optional<Turtlebot> robot;
  std::optional<Program> up;
};

/// On which a robot with one scanner hears it.
std::string scan_topic() {
  const std::string body = run_program({"config", "body", "--robot", kRobot}).output;
  return body.find("topic:") == std::string::npos ? "scan_front" : "scan";
}

WireSettings wire_of(bool is_stamped, Rmw rmw) {
  WireSettings wire;
  wire.scan_topic = scan_topic();
  wire.domain = kDomain;
  wire.stamped_commands = is_stamped;
  wire.rmw = rmw;
  return wire;
}
const Pose2 kInDock{7.0, 1.5, Angle::degrees(-90.0)};

TEST_F(TurtlebotTest, UndocksGuidesAndDocks) {
  begin(wire_of(true, Rmw::cyclonedds), kInDock, true);
  ASSERT_TRUE(eventually([&] { return watch->look().localized; }, 90s)) << told();
  std::cout << "localized: " << told() << '\n';
  watch->ask_for("exhibit", "particle-trap");
  ASSERT_TRUE(eventually([&] { return robot->goals().first >= 1 && !is_docked(); }, 60s)) << told();
  ASSERT_TRUE(eventually([&] { return watch->look().mission.exhibits_explained >= 1; }, 150s)) << told();
  std::cout << "explained: " << told() << '\n';
  const int before = robot->goals().first;
  robot->with_body([](Body& body) { body.battery = 0.1; });
  ASSERT_TRUE(eventually([&] { return is_docked(); }, 180s)) << told();
  EXPECT_GT(robot->goals().first, before) << "it docked by the action";
  EXPECT_TRUE(eventually([&] { return watch->look().mission.phase == "charging"; }, 20s)) << told();
  // The task itself is gone as soon as `mission` has heard that it is done.
  EXPECT_TRUE(eventually([&] { return watch->look().events["charger"] > 0; }, 20s)) << told();
  std::this_thread::sleep_for(5s);
  EXPECT_TRUE(is_docked()) << "it stays there: " << told();
  EXPECT_NEAR(place().y, kInDock.y, 0.05);
  std::cout << "docked: " << told() << ", told to move while it moved by itself for "
            << robot->with_body([](Body& body) { return body.commanded_s; }) << " s\n";
}

TEST_F(TurtlebotTest, UndocksWithTheOtherRmwAndPlainCommands) {
  begin(wire_of(false, Rmw::fastrtps), kInDock, true);
  ASSERT_TRUE(eventually([&] { return watch->look().localized; }, 90s)) << told();
  watch->ask_for("exhibit", "particle-trap");
  ASSERT_TRUE(eventually([&] { return robot->goals().first >= 1 && !is_docked(); }, 60s)) << told();
  const Pose2 undocked = place();
  EXPECT_TRUE(eventually([&] { return std::hypot(place().x - undocked.x, place().y - undocked.y) > 1.0; }, 60s))
      << told();
  EXPECT_EQ(robot->goals().second, 0) << "nothing was asked for twice";
}

TEST_F(TurtlebotTest, AnObstacleThatItTouchesAndACliffStopIt) {
  begin(wire_of(true, Rmw::cyclonedds), {7.0, 3.0, Angle::degrees(90.0)}, false);
  ASSERT_TRUE(eventually([&] { return watch->look().localized; }, 90s)) << told();
  watch->ask_for("exhibit", "particle-trap");
  // Straight on: who turns misses what is put before it.
  const auto drives = [&] {
    return robot->with_body([](Body& body) { return body.linear() > 0.2 && std::abs(body.angular()) < 0.1; });
  };
  ASSERT_TRUE(eventually(drives, 60s)) << told();
  // A low box 0.4 m ahead, which no scanner sees.
  robot->with_body([](Body& body) { body.boxes.push_back({body.map_from_robot() * Point2{0.45, 0.0}, 0.05}); });
  // It backs off by itself at once, so its bumpers are pressed for a moment only.
  ASSERT_TRUE(eventually([&] { return robot->with_body([](Body& body) { return body.bumps > 0; }); }, 10s)) << told();
  EXPECT_TRUE(eventually([&] { return std::abs(speed()) < 0.11; }, 1s));
  const Point2 box = robot->with_body([](Body& body) { return body.boxes.back().middle; });
  const auto apart = [&] { return std::hypot(place().x - box.x, place().y - box.y); };
  // It finds its way round, and does not run into it again and again.
  EXPECT_TRUE(eventually([&] { return apart() > 0.6; }, 90s)) << told() << " apart " << apart();
  std::cout << "round the box: " << told() << '\n';

  ASSERT_TRUE(eventually(drives, 60s)) << told();
  robot->with_body([](Body& body) { body.holes.push_back({body.map_from_robot() * Point2{0.75, 0.0}, 0.25}); });
  ASSERT_TRUE(eventually([&] { return robot->with_body([](Body& body) { return body.edges > 0; }); }, 20s)) << told();
  const Point2 hole = robot->with_body([](Body& body) { return body.holes.back().middle; });
  double nearest = 10.0;
  const auto watched = std::chrono::steady_clock::now();
  while (std::chrono::steady_clock::now() - watched < 15s) {
    nearest = std::min(nearest, std::hypot(place().x - hole.x, place().y - hole.y));
    std::this_thread::sleep_for(20ms);
  }
  EXPECT_GT(nearest, 0.25) << "its middle never was over the hole: " << told();
  std::cout << "nearest to the hole's middle " << nearest << " m: " << told() << '\n';
}

TEST_F(TurtlebotTest, StandsWhenItIsLiftedAndWhenItsBumpersFallSilent) {
  begin(wire_of(true, Rmw::cyclonedds), {7.0, 3.0, Angle::degrees(90.0)}, false);
  ASSERT_TRUE(eventually([&] { return watch->look().localized; }, 90s)) << told();
  watch->ask_for("exhibit", "particle-trap");
  ASSERT_TRUE(eventually([&] { return speed() > 0.2; }, 60s)) << told();
  robot->with_body([](Body& body) { body.is_lifted = true; });
  EXPECT_TRUE(
      eventually([&] { return watch->look().health["robot"].health.reason.starts_with("somebody has lifted"); }, 5s))
      << told();
  std::this_thread::sleep_for(2s);
  robot->with_body([](Body& body) { body.is_lifted = false; });
  ASSERT_TRUE(eventually([&] { return speed() > 0.1; }, 60s)) << told();
  robot->silence_hazards();
  EXPECT_TRUE(eventually([&] { return std::abs(speed()) < 0.001; }, 3s)) << told();
  EXPECT_TRUE(
      eventually([&] { return watch->look().health["avoid"].health.reason == "the tactile ring is silent"; }, 3s))
      << told();
}

TEST_F(TurtlebotTest, ABaseWithoutTheActionsIsNamed) {
  auto wire = wire_of(true, Rmw::cyclonedds);
  wire.offers_actions = false;
  begin(wire, kInDock, true);
  // It does not know its place before it has moved, and would move to find it.
  EXPECT_TRUE(eventually(
      [&] { return watch->look().health["executive"].health.reason == "the base offers no action /undock"; }, 90s))
      << told();
  std::this_thread::sleep_for(5s);
  EXPECT_NEAR(place().y, kInDock.y, 0.02) << "it is not torn from its dock";
}

}  // namespace
}  // namespace docent::turtlebot
