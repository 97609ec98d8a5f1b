#pragma once

#include <memory>

#include "docent/modules/shared/module.h"

namespace docent::modules {

/// `web`: shows the robot to the world and takes the world's wishes (architecture 3; [Rhino1999] 5.2). Section `web` of
/// robot.yaml: WebServerParams and WebParams. Error: the port is in use, or web.sqlite cannot be opened.
[[nodiscard]] Result<std::unique_ptr<Module>> make_web(const ModuleContext& context);
[[nodiscard]] Result<robot::ParameterRows> parameters_of_web(const robot::RobotConfig& config);

}  // namespace docent::modules
