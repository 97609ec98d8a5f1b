#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/modules/host/module_host.h"
#include "docent/museum/museum.h"
#include "docent/robot/robot_config.h"
#include "docent/transport/bus.h"

namespace CLI {
class App;
}

namespace docent::apps {

/// Makes the modules of a simulated or replayed robot. This one makes it whole; that of the laboratory cripples it, so
/// that an evaluation shows what the crippled part is for (architecture 10.17).
class RobotMaker {
 public:
  RobotMaker() = default;
  RobotMaker(const RobotMaker&) = delete;
  RobotMaker& operator=(const RobotMaker&) = delete;
  virtual ~RobotMaker() = default;

  /// The sections of robot.yaml that it reads itself.
  [[nodiscard]] virtual std::vector<std::string> sections() const { return {}; }
  /// Reads them, before any module is made, and amends the configuration. Error: with file and line.
  [[nodiscard]] virtual Result<void> read(robot::RobotConfig& config) {
    static_cast<void>(config);
    return {};
  }
  /// For reports: names of what is crippled, with ", " between them.
  [[nodiscard]] virtual std::string crippled() const { return ""; }
  /// @pre `read` was called with this configuration. Museum and configuration outlive the module.
  [[nodiscard]] virtual Result<std::unique_ptr<modules::ModuleHost>> make(const modules::ModuleEntry& entry,
                                                                          std::unique_ptr<transport::Bus> bus,
                                                                          const museum::Museum& museum,
                                                                          const robot::RobotConfig& config,
                                                                          const modules::ModuleHost::Options& options) {
    return modules::ModuleHost::create(entry, std::move(bus), museum, config, options);
  }
};

/// A command that runs the robot of a maker, as the commands of a program are added.
[[nodiscard]] inline std::function<void(CLI::App&)> with_robot(void (*command)(CLI::App&, std::shared_ptr<RobotMaker>),
                                                               std::shared_ptr<RobotMaker> robot) {
  return [command, robot = std::move(robot)](CLI::App& app) { command(app, robot); };
}

}  // namespace docent::apps
