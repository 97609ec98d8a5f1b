#pragma once

#include "docent/modules/shared/module.h"

namespace docent::modules {

/// `things`: what lies about on the floor, by the depth camera of `sight` and a colour camera; `office` tidies it up.
[[nodiscard]] Result<std::unique_ptr<Module>> make_things(const ModuleContext& context);
[[nodiscard]] Result<robot::ParameterRows> parameters_of_things(const robot::RobotConfig& config);

}  // namespace docent::modules
