#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "docent/base/result.h"
#include "docent/simulator/cameras.h"
#include "docent/simulator/crowd/crowd_params.h"
#include "docent/simulator/hardware.h"
#include "docent/simulator/scenario/scenario.h"
#include "docent/simulator/world/charger_contacts.h"
#include "docent/simulator/world/world.h"
#include "docent/transport/bus.h"

namespace docent::simulator {

struct SimulationOptions {
  World world;
  Hardware hardware;
  std::uint64_t seed = 0;
  std::string crowd = "busy";              ///< empty, quiet, busy, packed (architecture 10.3)
  std::optional<std::size_t> crowd_count;  ///< instead of the level's density; recorded people are among them
  CrowdParams crowd_params;
  std::optional<Bodies> bodies;             ///< instead of what crowd_params says
  std::optional<double> heedless;           ///< 0..1 likewise: share of people who do not evade
  std::optional<Pose2> start;               ///< world_from_base; without: random, free, inside the operating area
  std::optional<Point2> charger;            ///< [m]; standing within 0.4 m of it charges the battery
  std::optional<ChargerContacts> contacts;  ///< instead: what of the charger a base must meet
  double battery = 1.0;                     ///< 0..1 at the start
  std::optional<CameraOptions> cameras;     ///< without: none is simulated, which costs nothing
  Scenario scenario;
  /// Does what the museum cannot do, when its time has come: the application's part of the scenario.
  std::function<void(const std::variant<Kill, PoseError, SecondMode>&)> application;
  std::optional<double> requests_per_hour;  ///< instead of the world's visitors_per_hour
  docent_msgs::RunInfo run_info;            ///< museum, mode, config_hash, ...; seed and crowd are filled in
};

/// Error: an unknown crowd level, a start inside a wall, a world without floor.
[[nodiscard]] Result<void> validate(const SimulationOptions& options);

/// The museum, its visitors and the robot's body: what the modules of the robot have round them in simulation. It
/// stands for hardware and people (architecture 10.1, 10.10) and knows the truth, which it tells on `truth_bus` alone.
///
/// Driven by timers of `robot_bus`, so it runs in virtual time and in real time. Steps of 10 ms; in real time it skips
/// what it missed by more than half a second. Bit-for-bit the same for the same options and commands.
class SimulatedMuseum {
 public:
  /// Subscribes cmd_vel, docent/horn, docent/speech_state, docent/expression, scene_camera/view, docent/request_board
  /// and docent/mission_state; publishes what its hardware has of scan_front, scan_rear, scan_left, scan_right, sonar,
  /// infrared and tactile, and odom, the pictures of its cameras, battery_state, docent/request and docent/choice, and
  /// the truth. The truth is posted to `truth_bus`, so under DDS both buses must be run, each on a thread of its own if
  /// need be. Both buses must outlive it or die before the next event; it may be destroyed at any time.
  /// @pre validate(options)
  SimulatedMuseum(transport::Bus& robot_bus, transport::Bus& truth_bus, SimulationOptions options);
  SimulatedMuseum(const SimulatedMuseum&) = delete;
  SimulatedMuseum& operator=(const SimulatedMuseum&) = delete;
  ~SimulatedMuseum();

  [[nodiscard]] Pose2 world_from_base() const;
  [[nodiscard]] std::size_t people() const;
  [[nodiscard]] double free_area() const;  ///< [m2]

 private:
  class Impl;
  std::shared_ptr<Impl> impl_;  ///< timers hold it weakly
};

}  // namespace docent::simulator
