#pragma once

#include "docent/modules/shared/module.h"

namespace docent::modules {

/// Collision avoidance: the only one that publishes docent/drive (architecture 10.7).
[[nodiscard]] Result<std::unique_ptr<Module>> make_avoid(const ModuleContext& context);
[[nodiscard]] Result<robot::ParameterRows> parameters_of_avoid(const robot::RobotConfig& config);

}  // namespace docent::modules
