#pragma once

#include "docent/modules/shared/module.h"

namespace docent {

/// Collision avoidance: the only one that publishes docent/drive (architecture 10.7).
[[nodiscard]] Result<std::unique_ptr<Module>> make_avoid(const ModuleContext& context);
[[nodiscard]] Result<ParameterRows> parameters_of_avoid(const RobotConfig& config);

}  // namespace docent
