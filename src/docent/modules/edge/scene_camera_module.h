#pragma once

#include "docent/modules/shared/module.h"

namespace docent::modules {

/// `scene_camera`: turns the camera in the hall towards the robot, on scene_camera/view, twice a second and when it
/// moves; does nothing in a museum without one. The mount's driver, or the simulator, obeys it. Section `scene_camera`.
[[nodiscard]] Result<std::unique_ptr<Module>> make_scene_camera(const ModuleContext& context);
[[nodiscard]] Result<robot::ParameterRows> parameters_of_scene_camera(const robot::RobotConfig& config);

}  // namespace docent::modules
