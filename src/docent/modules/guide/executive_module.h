#pragma once

#include "docent/modules/shared/module.h"

namespace docent {

/// `executive`: does the mission's task step by step. Checkpoint: state/executive.json.
[[nodiscard]] Result<std::unique_ptr<Module>> make_executive(const ModuleContext& context);
[[nodiscard]] Result<ParameterRows> parameters_of_executive(const RobotConfig& config);

}  // namespace docent
