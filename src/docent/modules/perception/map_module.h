#pragma once

#include "docent/modules/shared/module.h"

namespace docent::modules {

/// `map`: the static map, latched with its hash, and the live map as a full map and numbered updates.
[[nodiscard]] Result<std::unique_ptr<Module>> make_map(const ModuleContext& context);
[[nodiscard]] Result<robot::ParameterRows> parameters_of_map(const robot::RobotConfig& config);

}  // namespace docent::modules
