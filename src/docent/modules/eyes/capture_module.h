#pragma once

#include <memory>

#include "docent/modules/shared/module.h"
#include "docent/vision/capture/video_calls.h"

namespace docent::modules {

/// `capture`: pictures of a camera at the computer itself (Video4Linux), for the eye that robot.yaml names.
[[nodiscard]] Result<std::unique_ptr<Module>> make_capture(const ModuleContext& context);
/// The same with system calls of the caller's.
[[nodiscard]] Result<std::unique_ptr<Module>> make_capture_with(const ModuleContext& context,
                                                                std::unique_ptr<vision::VideoCalls> calls);
[[nodiscard]] Result<robot::ParameterRows> parameters_of_capture(const robot::RobotConfig& config);

}  // namespace docent::modules
