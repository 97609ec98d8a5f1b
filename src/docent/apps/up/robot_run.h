#pragma once

#include <string>

#include "docent/apps/shared/deployment.h"
#include "docent/apps/up/simulator_process.h"

namespace docent::apps::up_command {

/// A robot: every module as a process of its own, watched and restarted.
struct RobotRun {
  Deployment deployment;
  bool simulate = false;
  int port = 8080;
  std::string record;      ///< MCAP file; empty: what is recorded stays in the folder of the state
  std::string page = "/";  ///< that is told to whoever has started it
  SimulatorOptions simulator;
};

/// Makes the folder of the state and keeps others out of it until the process ends: two robots would write the same
/// checkpoints. Once is enough. Error: another one works there.
[[nodiscard]] Result<void> own_state(const Deployment& deployment);

/// Runs it until the process is told to end; CommandFailed where something is wrong that can be known before.
void run_robot(const RobotRun& options);

}  // namespace docent::apps::up_command
