#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <stop_token>
#include <vector>

#include "docent/modules/drive/create3_hazards.h"
#include "docent/modules/guide/dock_client.h"
#include "docent/transport/dds_bus.h"
#include "turtlebot_wire.h"

// What Docent says to the dock and reads of hazards, over DDS, beside the TurtleBot alone: no robot of ours runs.

namespace docent::turtlebot {
namespace {

constexpr int kDomain = 89;
const Pose2 kInDock{2.0, 2.0, Angle::degrees(-90.0)};

/// An empty hall of four metres.
Settings in_a_hall() {
  Settings settings;
  settings.world.frame = {80, 80, 0.05, {}};
  settings.world.cells.assign(settings.world.frame.size(), OccupancyGrid::kFree);
  settings.map_from_dock = settings.map_from_robot = kInDock;
  return settings;
}

class Wire : public ::testing::TestWithParam<Rmw> {
 protected:
  Wire() : bus{std::move(*transport::DdsBus::create({kDomain, "", {}}))} {}
  void begin(Rmw rmw) {
    WireSettings wire;
    wire.domain = kDomain;
    wire.rmw = rmw;
    robot.emplace(in_a_hall(), wire);
  }
  /// Runs the bus until then. @returns whether it came to that
  bool until(const std::function<bool()>& done, double patience_s) {
    std::stop_source stop;
    const Time end = bus->now() + seconds(patience_s);
    bool is_done = false;
    const std::function<void()> look = [&] {
      if (stop.stop_requested()) return;
      is_done = is_done || done();
      if (is_done || bus->now() >= end)
        stop.request_stop();
      else
        bus->after(std::chrono::milliseconds{50}, look);
    };
    bus->after(std::chrono::milliseconds{1}, look);
    bus->run(stop.get_token());
    return is_done;
  }
  std::unique_ptr<transport::DdsBus> bus;
  std::optional<Turtlebot> robot;
};

TEST_P(Wire, UndocksAndDocksByItsActions) {
  begin(GetParam());
  modules::DockClient client{*bus};
  const auto settles = [&] {
    client.tick();
    return !client.is_moving() && client.complaint().empty();
  };
  ASSERT_TRUE(until([&] { return client.is_known(); }, 10.0));
  EXPECT_TRUE(client.is_docked());
  client.want(modules::DockClient::Wish::free);
  ASSERT_TRUE(until([&] { return settles() && !client.is_docked(); }, 60.0)) << client.complaint();
  client.want(modules::DockClient::Wish::docked);
  ASSERT_TRUE(until([&] { return settles() && client.is_docked(); }, 90.0)) << client.complaint();
  EXPECT_EQ(robot->goals(), (std::pair<int, int>{2, 0})) << "each was asked for once";
  EXPECT_NEAR(robot->with_body([](Body& body) { return body.map_from_robot().y; }), kInDock.y, 0.05);
}
INSTANTIATE_TEST_SUITE_P(BothRmws, Wire, ::testing::Values(Rmw::cyclonedds, Rmw::fastrtps));

TEST_F(Wire, BumpersAndCliffsComeAsEveryBaseTellsThem) {
  begin(Rmw::cyclonedds);
  modules::Create3Hazards adapter{*bus, 0.18};
  docent_msgs::Tactile ring;
  docent_msgs::ObstacleLines lines;
  auto ears = std::move(*transport::DdsBus::create({kDomain, "", {}}));
  ears->subscribe<docent_msgs::Tactile>(topics::kTactile, [&](const auto& tactile) { ring = tactile; });
  ears->subscribe<docent_msgs::ObstacleLines>(topics::kObstacleLines, [&](const auto& seen) { lines = seen; });
  const std::jthread listens{[&](const std::stop_token& stop) { ears->run(stop); }};
  ASSERT_TRUE(until([&] { return adapter.complaint().empty() && ring.segments.size() == 20; }, 10.0));
  robot->with_body([](Body& body) { body.boxes.push_back({body.map_from_robot() * Point2{0.2, 0.0}, 0.03}); });
  EXPECT_TRUE(until([&] { return ring.segments.at(0) == 1; }, 5.0));
  EXPECT_EQ(ring.segments.at(10), 0) << "nothing touches it behind";
  robot->with_body([](Body& body) {
    body.boxes.clear();
    body.holes.push_back({body.map_from_robot() * Point2{0.15, 0.05}, 0.05});
  });
  EXPECT_TRUE(until([&] { return ring.segments.at(0) == 0 && lines.lines.size() == 2; }, 5.0));
  ASSERT_EQ(lines.lines.size(), 2U);
  EXPECT_GT(lines.lines[0].x1, 0.1F) << "the edge";
  EXPECT_LT(lines.lines[1].x1, -0.2F) << "it has not driven yet, so it backs no farther";
  robot->with_body([](Body& body) { body.is_lifted = true; });
  EXPECT_TRUE(until([&] { return ring.segments.at(0) == 255; }, 5.0));
}

}  // namespace
}  // namespace docent::turtlebot
