#pragma once

#include "docent/modules/shared/module.h"

namespace docent::modules {

/// `plan`: value iteration to the goal over the live map; hands `avoid` via-points and says how it goes.
[[nodiscard]] Result<std::unique_ptr<Module>> make_plan(const ModuleContext& context);
[[nodiscard]] Result<robot::ParameterRows> parameters_of_plan(const robot::RobotConfig& config);

/// The robot for which `plan` plans under this configuration. Error: the section is faulty.
[[nodiscard]] Result<museum::CheckedRobot> checked_robot_of_plan(const robot::RobotConfig& config);

}  // namespace docent::modules
