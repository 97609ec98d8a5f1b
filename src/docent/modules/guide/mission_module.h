#pragma once

#include "docent/modules/shared/module.h"

namespace docent::modules {

/// `mission`: what the robot does next. The single writer of the request board; commits to state/mission.sqlite before
/// it publishes (architecture 10.8, 10.9).
[[nodiscard]] Result<std::unique_ptr<Module>> make_mission(const ModuleContext& context);
[[nodiscard]] Result<robot::ParameterRows> parameters_of_mission(const robot::RobotConfig& config);

}  // namespace docent::modules
