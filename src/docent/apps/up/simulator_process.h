#pragma once

#include <string>

#include "docent/apps/shared/deployment.h"

namespace docent::apps::up_command {

inline constexpr const char* kSimulatorProcess = "sim";

/// What the simulated museum is told besides.
struct SimulatorOptions {
  std::string crowd = "busy";    ///< empty, quiet, busy, packed
  std::string bodies = "discs";  ///< how people are built: legs or discs
  double heedless = 0.0;         ///< 0..1 share of people who do not evade
  std::string start;             ///< X,Y,DEG; empty: somewhere
  std::string world;             ///< what is simulated, a museum's folder or its file; empty: the robot's own museum
  std::string scenario;          ///< file; empty: nothing special happens
  std::string mode = "open";
  bool has_cameras = true;
  double requests_per_hour = -1.0;  ///< < 0: as the museum's simulation says

  void add_options(CLI::App& command);
  [[nodiscard]] std::vector<std::string> arguments() const;
};

/// `docent run sim`: the museum, its visitors and the robot's body in wall time, until the process is told to end. It
/// stands for hardware: the robot's domain sees its sensors, the truth's domain what is true (architecture 10.1).
/// Error: the world, the scenario or the start cannot be.
[[nodiscard]] Result<void> run_simulator(const Deployment& deployment, const SimulatorOptions& options);

/// The same checks, without running.
[[nodiscard]] Result<void> check_simulator(const Deployment& deployment, const SimulatorOptions& options);

}  // namespace docent::apps::up_command
