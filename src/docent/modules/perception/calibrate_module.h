#pragma once

#include "docent/modules/shared/module.h"

namespace docent::modules {

/// `calibrate`: where the scanners are mounted, how late they are, and what odometry is worth, found out while the
/// robot drives. The other modules take what it says; it names what contradicts robot.yaml.
[[nodiscard]] Result<std::unique_ptr<Module>> make_calibrate(const ModuleContext& context);
[[nodiscard]] Result<robot::ParameterRows> parameters_of_calibrate(const robot::RobotConfig& config);

}  // namespace docent::modules
