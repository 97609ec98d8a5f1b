#pragma once

#include "docent/modules/shared/module.h"

namespace docent::modules {

/// `visualize`: what the robot knows, in the messages that viewers of ROS 2 draw. No module reads them.
[[nodiscard]] Result<std::unique_ptr<Module>> make_visualize(const ModuleContext& context);
[[nodiscard]] Result<robot::ParameterRows> parameters_of_visualize(const robot::RobotConfig& config);

}  // namespace docent::modules
