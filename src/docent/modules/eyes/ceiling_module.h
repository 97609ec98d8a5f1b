#pragma once

#include "docent/modules/shared/module.h"

namespace docent::modules {

/// `ceiling`: where the robot is by a camera that looks at the ceiling, as a fix for `localize`.
[[nodiscard]] Result<std::unique_ptr<Module>> make_ceiling(const ModuleContext& context);
[[nodiscard]] Result<robot::ParameterRows> parameters_of_ceiling(const robot::RobotConfig& config);

}  // namespace docent::modules
