#pragma once

#include "docent/collision_avoidance/local_planner/local_planner.h"
#include "docent/modules/shared/module.h"

namespace docent::modules {

/// Collision avoidance: the only one that publishes docent/drive (architecture 10.7).
[[nodiscard]] Result<std::unique_ptr<Module>> make_avoid(const ModuleContext& context);
/// The same with another local planner than the one that the configuration names.
[[nodiscard]] Result<std::unique_ptr<Module>> make_avoid_with(
    const ModuleContext& context, const collision_avoidance::LocalPlannerMaker& make_planner);
[[nodiscard]] Result<robot::ParameterRows> parameters_of_avoid(const robot::RobotConfig& config);

}  // namespace docent::modules
