#pragma once

#include "docent/modules/shared/module.h"

namespace docent {

/// Records every topic of the robot, and the truth where a simulator runs, to --state DIR/recordings. Section `record`.
/// Does nothing in virtual time: there `--record` decides.
[[nodiscard]] Result<std::unique_ptr<Module>> make_record(const ModuleContext& context);
[[nodiscard]] Result<ParameterRows> parameters_of_record(const RobotConfig& config);

}  // namespace docent
