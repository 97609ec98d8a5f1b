#pragma once

#include "docent/modules/shared/module.h"

namespace docent::modules {

/// `sight`: what a depth camera sees in the way, and where the floor ends, as lines that `avoid` keeps off and `map`
/// remembers.
[[nodiscard]] Result<std::unique_ptr<Module>> make_sight(const ModuleContext& context);
[[nodiscard]] Result<robot::ParameterRows> parameters_of_sight(const robot::RobotConfig& config);

}  // namespace docent::modules
