#pragma once

#include "docent/modules/shared/module.h"

namespace docent::modules {

/// Virtual range measurements of what no sensor sees, from every belief (architecture 8.3).
[[nodiscard]] Result<std::unique_ptr<Module>> make_hazards(const ModuleContext& context);
[[nodiscard]] Result<robot::ParameterRows> parameters_of_hazards(const robot::RobotConfig& config);

}  // namespace docent::modules
