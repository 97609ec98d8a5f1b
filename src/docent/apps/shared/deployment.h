#pragma once

#include <cstdint>
#include <stop_token>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/grid/map_reading.h"
#include "docent/museum/editing/museum_setup.h"
#include "docent/museum/museum.h"
#include "docent/robot/robot_config.h"
#include "docent/transport/dds_bus.h"
#include "docent/transport/dds_reach.h"

namespace CLI {
class App;
}

namespace docent::apps {

/// What every process of one robot is told: the options that `docent up` and `docent run` share.
struct Deployment {
  std::string museum;                 ///< folder
  std::string state;                  ///< folder of checkpoints and databases
  std::string cache;                  ///< folder of what can be made anew; empty: nothing is kept
  std::string robot;                  ///< robot.yaml; empty: all defaults
  std::vector<std::string> settings;  ///< section.key=value, over robot.yaml
  std::string name;                   ///< prefix of the topics
  int domain = 0;
  std::string interface = "lo";  ///< a network interface that DDS hears beside loopback; "lo": none
  std::uint64_t seed = 1;
  bool is_setup = false;  ///< the museum is being set up: setup.yaml of its folder says how far it is
  std::string explore;    ///< X,Y,DEG: it begins there and maps the museum by itself; empty: it has its map

  /// Whether the command names the museum in another way than by --museum.
  enum class Museum { is_option, is_given };
  void add_options(CLI::App& command, Museum named = Museum::is_option);
  /// Those of add_options that say what the robot is and where it is on the bus.
  void add_robot_options(CLI::App& command);
  void add_bus_options(CLI::App& command);
  /// As arguments of another process.
  [[nodiscard]] std::vector<std::string> arguments() const;
  /// Without its map where the robot explores. `progress` hears how far the reading of the map is.
  [[nodiscard]] Result<museum::Museum> load(const ReadingProgress& progress = {}) const;
  [[nodiscard]] bool is_exploring() const { return !explore.empty(); }
  [[nodiscard]] Result<museum::SetupWork> work() const;
  /// @param further  sections beside `body` and those of the modules
  [[nodiscard]] Result<robot::RobotConfig> load_config(const std::vector<std::string>& further = {}) const;
  /// How a process of this robot joins a domain of DDS: as the node docent_PROCESS, with the topics of this body.
  [[nodiscard]] transport::DdsOptions bus_options(int dds_domain, const std::string& process,
                                                  const robot::RobotBody& body) const;
  /// What the processes of ROS 2 must be told to hear this robot.
  [[nodiscard]] std::vector<transport::RosLine> ros_lines() const;
  /// Makes the folder of the state; all that this process and its children write from then on is for its owner alone.
  [[nodiscard]] Result<void> prepare_state() const;
};

/// The museum of Bonn that comes with the program.
[[nodiscard]] std::string default_museum();
/// $XDG_STATE_HOME/docent, else ~/.local/state/docent.
[[nodiscard]] std::string default_state();

/// Blocks SIGTERM, SIGINT and SIGHUP in this thread and those that it starts: they are waited for instead.
void block_end_signals();
/// Waits for one of them. @param timeout_s  < 0: as long as it takes
/// @returns its number, 0 when none came
[[nodiscard]] int wait_for_end_signal(double timeout_s);

/// Stops when one of them comes. @pre block_end_signals() was called before any thread was started
[[nodiscard]] std::stop_token end_signal();

}  // namespace docent::apps
