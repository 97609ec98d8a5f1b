#pragma once

#include "docent/modules/shared/module.h"

namespace docent::modules {

/// `head`: decides what the robot shows, in one place: its mood (interaction/mood) and where its head looks
/// (interaction/head). Publishes docent/expression and, for a robot with a head of servos, head/joint_command: where
/// head_pan_joint, head_tilt_joint, left_brow_joint, right_brow_joint, mouth_joint and jaw_joint shall be, ten times a
/// second. What they are is for their drivers to say, on joint_states. It keeps nothing over a restart.
[[nodiscard]] Result<std::unique_ptr<Module>> make_head(const ModuleContext& context);
[[nodiscard]] Result<robot::ParameterRows> parameters_of_head(const robot::RobotConfig& config);

}  // namespace docent::modules
