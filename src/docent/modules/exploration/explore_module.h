#pragma once

#include "docent/modules/shared/module.h"

namespace docent::modules {

/// `explore`: maps a building of which it has no map, drives to where something is unknown, and comes back. It takes
/// the place of localize, map, plan, mission and executive: it publishes the belief, the map and the targets for avoid.
/// What it learned lies in `explored` in the folder of the state when it is done.
[[nodiscard]] Result<std::unique_ptr<Module>> make_explore(const ModuleContext& context);
[[nodiscard]] Result<robot::ParameterRows> parameters_of_explore(const robot::RobotConfig& config);

}  // namespace docent::modules
