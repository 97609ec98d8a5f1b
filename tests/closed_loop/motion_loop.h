#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "docent/base/random.h"
#include "docent/messages/conversions.h"
#include "docent/modules/host/module_host.h"
#include "docent/simulator/simulated_museum.h"
#include "docent/transport/virtual_time_bus.h"

namespace docent {

/// The modules that move the robot (avoid, hazards, robot, map, plan) in the simulated museum, under a belief made from
/// the truth with an error that wanders: what motion does, apart from what localization does. Drives from exhibit to
/// exhibit, in an order drawn from the seed.
class MotionLoop {
 public:
  struct Options {
    std::string museum = "museums/bonn";
    std::string crowd = "busy";
    std::uint64_t seed = 1;
    double position_error = 0.06;  ///< [m] standard deviation of the wandering error, each axis
    double heading_error = 0.015;  ///< [rad]
    simulator::Scenario scenario{};
    std::vector<std::string> settings{};  ///< section.key=value, over robot.yaml's defaults
  };
  struct Outcome {
    double seconds = 0.0;
    double goal_seconds = 0.0;  ///< a goal was active and not reached
    double distance = 0.0;      ///< [m]
    double top_speed = 0.0;
    int arrived = 0;
    int given_up = 0;
    int horns = 0;
    double longest_standstill = 0.0;      ///< [s] with an active goal
    std::map<std::string, int> contacts;  ///< by kind; people by who is to blame: people, bumped
    double seconds_outside = 0.0;
    std::map<std::string, double> standing;  ///< [s] by the reason that avoid gave while a goal was active
    std::vector<std::string> log;
    double avoid_cost_ms = 0.0;    ///< a second
    double hazards_cost_ms = 0.0;  ///< a second
  };

  explicit MotionLoop(const Options& options);
  ~MotionLoop();
  void run(double duration);
  [[nodiscard]] const Outcome& outcome();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace docent
