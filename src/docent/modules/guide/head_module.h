#pragma once

#include "docent/modules/shared/module.h"

namespace docent::modules {

/// `head`: decides what the robot shows, in one place: its mood (interaction/mood) and where its head looks
/// (interaction/head). Publishes docent/expression and, for a robot with a pan-tilt head, joint_states with
/// head_pan_joint and head_tilt_joint, ten times a second. It keeps nothing over a restart.
[[nodiscard]] Result<std::unique_ptr<Module>> make_head(const ModuleContext& context);
[[nodiscard]] Result<robot::ParameterRows> parameters_of_head(const robot::RobotConfig& config);

}  // namespace docent::modules
