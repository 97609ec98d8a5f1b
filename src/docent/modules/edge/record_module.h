#pragma once

#include "docent/modules/shared/module.h"

namespace docent::modules {

/// Records every topic of the robot, and the truth where a simulator runs, to --state DIR/recordings. Section `record`.
/// Does nothing in virtual time: there `--record` decides.
[[nodiscard]] Result<std::unique_ptr<Module>> make_record(const ModuleContext& context);
[[nodiscard]] Result<robot::ParameterRows> parameters_of_record(const robot::RobotConfig& config);

}  // namespace docent::modules
