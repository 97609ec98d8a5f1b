#pragma once

#include <memory>

#include "docent/modules/shared/module.h"

namespace docent::modules {

/// `buttons`: the four coloured buttons beside the robot's screen ([Rhino1999] 5.1), as presses on docent/button.
/// Section `buttons` of robot.yaml: interaction::ButtonParams. The device may come and go. In virtual time nothing is
/// read: nobody can press.
[[nodiscard]] Result<std::unique_ptr<Module>> make_buttons(const ModuleContext& context);
[[nodiscard]] Result<robot::ParameterRows> parameters_of_buttons(const robot::RobotConfig& config);

}  // namespace docent::modules
