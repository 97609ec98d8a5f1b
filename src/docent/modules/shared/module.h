#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/museum/museum.h"
#include "docent/museum/wall_clock.h"
#include "docent/robot/parameter_list.h"
#include "docent/robot/robot_config.h"
#include "docent/transport/bus.h"

namespace docent::modules {

/// What a module is given. All references outlive the module.
struct ModuleContext {
  transport::Bus& bus;
  const museum::Museum& museum;
  const robot::RobotConfig& config;
  std::filesystem::path state;  ///< --state DIR: checkpoints, databases; exists
  std::uint64_t seed = 0;
  bool virtual_time = false;
  /// For `record` alone, where a simulator runs: the bus of what is true. Its handlers run on a thread of their own, so
  /// they `bus.post` what they got. Null everywhere else.
  transport::Bus* truth = nullptr;
  Duration day_begins = std::chrono::hours{10};  ///< the time of day at which virtual time begins
  std::filesystem::path cache{};                 ///< --cache DIR: what can be made anew; empty: nothing is kept
  /// The museum is being set up, and `web` has the page for it.
  bool is_setup = false;
  museum::CheckedRobot checked_robot{};  ///< for which a museum is checked: that for which `plan` plans
  museum::Clocks clocks{};
};

struct ModuleHealth {
  std::string state = "ready";  ///< starting, ready, degraded, faulted
  std::string reason;
};

/// A module: a thin coat that subscribes, converts, calls a capability and publishes. It may be destroyed and made
/// again at any time (architecture 3): it restores its checkpoint and publishes its latched state in its constructor.
class Module {
 public:
  Module() = default;
  Module(const Module&) = delete;
  Module& operator=(const Module&) = delete;
  virtual ~Module() = default;
  [[nodiscard]] virtual ModuleHealth health() const { return {}; }
};

/// Error: a fault of the configuration, with file and line. Every module NAME has `make_NAME` in NAME_module.h.
using ModuleFactory = Result<std::unique_ptr<Module>> (*)(const ModuleContext& context);
/// The keys of a module's section of robot.yaml with the values that hold; error: as above. `parameters_of_NAME`.
using ModuleParameters = Result<robot::ParameterRows> (*)(const robot::RobotConfig& config);

}  // namespace docent::modules
