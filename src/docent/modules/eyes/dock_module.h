#pragma once

#include "docent/modules/shared/module.h"

namespace docent::modules {

/// `dock`: docks at the charger by its tag, when the executive orders it; says whether it could.
[[nodiscard]] Result<std::unique_ptr<Module>> make_dock(const ModuleContext& context);
[[nodiscard]] Result<robot::ParameterRows> parameters_of_dock(const robot::RobotConfig& config);

}  // namespace docent::modules
