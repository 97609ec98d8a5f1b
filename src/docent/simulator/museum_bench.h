#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "docent/base/random.h"
#include "docent/messages/conversions.h"
#include "docent/simulator/simulated_museum.h"
#include "docent/transport/virtual_time_bus.h"

// For tests of the simulated museum.

namespace docent::simulator {

inline Polygon box(double x0, double y0, double x1, double y1) { return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}; }

inline World hall() {
  World world;
  world.floor = box(0.0, 0.0, 20.0, 14.0);
  world.operating_area = box(1.0, 1.0, 19.0, 13.0);
  world.home = {3.0, 3.0};
  world.entrances = {{1.0, 1.0}};
  world.solids.push_back({"outer-west", SolidKind::wall, box(-0.2, -0.2, 0.0, 14.2), 0.0, 3.0, false});
  world.solids.push_back({"outer-east", SolidKind::wall, box(20.0, -0.2, 20.2, 14.2), 0.0, 3.0, false});
  world.solids.push_back({"outer-south", SolidKind::wall, box(0.0, -0.2, 20.0, 0.0), 0.0, 3.0, false});
  world.solids.push_back({"outer-north", SolidKind::wall, box(0.0, 14.0, 20.0, 14.2), 0.0, 3.0, false});
  world.solids.push_back({"case", SolidKind::glass, box(9.0, 6.0, 11.0, 7.0), 0.0, 1.5, false});
  world.solids.push_back({"plate", SolidKind::plate, box(14.0, 3.0, 16.0, 5.0), 0.0, 0.05, false});
  world.solids.push_back({"stairs", SolidKind::stairs, box(14.0, 10.0, 18.0, 12.0), -3.0, 0.0, false});
  world.solids.push_back({"bench", SolidKind::furniture, box(4.0, 10.0, 6.0, 10.5), 0.0, 0.45, false});
  world.attractions = {
      {"case", {10.0, 6.5}, 1.6, 1.0}, {"bench", {5.0, 10.2}, 1.2, 1.0}, {"plate", {15.0, 4.0}, 2.0, 1.0}};
  world.exhibits = {"case", "plate"};
  world.tours = {"all"};
  return world;
}

/// The simulator on a hub, with everything it says collected.
struct Bench {
  transport::VirtualTimeHub hub;
  std::unique_ptr<transport::Bus> simulator_bus = hub.connect("simulator");
  std::unique_ptr<transport::Bus> robot_bus = hub.connect("robot");
  transport::Publisher<geometry_msgs::Twist> commands = robot_bus->publisher(topics::kCommandVelocity);
  std::unique_ptr<SimulatedMuseum> museum;
  geometry_msgs::Twist wanted;
  bool sends = true;
  std::map<std::string, int> counts;
  std::uint64_t hash = hash_of("");          ///< of all but the cameras' pictures
  std::uint64_t picture_hash = hash_of("");  ///< of these
  std::vector<docent_msgs::TrueContact> contacts;
  docent_msgs::TrueState state;
  std::vector<docent_msgs::Request> requests;
  std::vector<docent_msgs::TrueOffer> offers;

  explicit Bench(SimulationOptions options) {
    hub.tap([this](const transport::TopicInfo& topic, Time time, const std::shared_ptr<const void>& message) {
      ++counts[topic.name];
      const auto bytes = topic.type->encode(message.get());
      const std::string_view name{topic.name};
      const bool is_picture = name == topics::kCamera.name || name == topics::kSceneCamera.name ||
                              name.starts_with("depth_camera/") || name.starts_with("front_camera/") ||
                              name.starts_with("ceiling_camera/");
      std::uint64_t& sum = is_picture ? picture_hash : hash;
      sum = hash_of({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, sum);
      sum = hash_of(std::to_string(time.nanoseconds) + topic.name, sum);
    });
    const auto keep = [this](const auto& topic, auto& list) {
      using Message = typename std::decay_t<decltype(topic)>::Type;
      robot_bus->subscribe(topic,
                           std::function<void(const Message&)>{[&list](const Message& m) { list.push_back(m); }});
    };
    keep(topics::kTrueContact, contacts);
    keep(topics::kRequest, requests);
    keep(topics::kTrueOffer, offers);
    robot_bus->subscribe(topics::kTrueState, std::function<void(const docent_msgs::TrueState&)>{
                                                 [this](const docent_msgs::TrueState& m) { state = m; }});
    museum = std::make_unique<SimulatedMuseum>(*simulator_bus, *simulator_bus, std::move(options));
    robot_bus->every(seconds(0.05), [this] {
      if (sends) commands.publish(wanted);
    });
  }
  void run(double duration) { hub.run_until(hub.now() + seconds(duration)); }
  void drive(double linear, double angular, double duration) {
    wanted.linear.x = linear;
    wanted.angular.z = angular;
    run(duration);
  }
};

inline SimulationOptions options(std::string crowd, std::optional<Pose2> start = std::nullopt, std::uint64_t seed = 1) {
  SimulationOptions result;
  result.world = hall();
  result.crowd = std::move(crowd);
  result.start = start;
  result.seed = seed;
  return result;
}

}  // namespace docent::simulator
