#pragma once

#include "docent/modules/shared/module.h"

namespace docent::modules {

/// Between the base and everybody else: passes each docent/drive on as cmd_vel at once, and the last one at 20 Hz
/// while it is fresh, zero otherwise (architecture 8.1, 10.7); publishes the frames.
[[nodiscard]] Result<std::unique_ptr<Module>> make_robot(const ModuleContext& context);
/// Whether its section says that the base is an iRobot Create 3.
[[nodiscard]] Result<bool> base_is_create3(const robot::RobotConfig& config);
[[nodiscard]] Result<robot::ParameterRows> parameters_of_robot(const robot::RobotConfig& config);

}  // namespace docent::modules
