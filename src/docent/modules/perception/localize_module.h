#pragma once

#include "docent/modules/shared/module.h"

namespace docent::modules {

/// `localize`: the belief over the robot's place, its pose when it is sure of one, and the beams that the map does not
/// explain.
[[nodiscard]] Result<std::unique_ptr<Module>> make_localize(const ModuleContext& context);
[[nodiscard]] Result<robot::ParameterRows> parameters_of_localize(const robot::RobotConfig& config);

/// The instruction set that `localize` runs with under this configuration: plain, avx2 or avx512. Error: the section is
/// faulty.
[[nodiscard]] Result<std::string> simd_of_localize(const robot::RobotConfig& config);

}  // namespace docent::modules
