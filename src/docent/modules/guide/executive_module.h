#pragma once

#include "docent/modules/shared/module.h"

namespace docent::modules {

/// `executive`: does the mission's task step by step. Checkpoint: state/executive.json.
[[nodiscard]] Result<std::unique_ptr<Module>> make_executive(const ModuleContext& context);
[[nodiscard]] Result<robot::ParameterRows> parameters_of_executive(const robot::RobotConfig& config);

}  // namespace docent::modules
