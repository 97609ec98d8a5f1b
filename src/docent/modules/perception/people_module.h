#pragma once

#include "docent/modules/shared/module.h"

namespace docent::modules {

/// `people`: people found by the inverse filter of `localize`, tracked in odometry's frame and published in it and in
/// the map's.
[[nodiscard]] Result<std::unique_ptr<Module>> make_people(const ModuleContext& context);
[[nodiscard]] Result<robot::ParameterRows> parameters_of_people(const robot::RobotConfig& config);

}  // namespace docent::modules
