#pragma once

#include "docent/modules/shared/module.h"

namespace docent::modules {

/// `office`: brings things to rooms and tidies up, as `docent/office_order` says. It wishes for places as the staff do,
/// and so never drives past the mission or the collision avoidance.
[[nodiscard]] Result<std::unique_ptr<Module>> make_office(const ModuleContext& context);
[[nodiscard]] Result<robot::ParameterRows> parameters_of_office(const robot::RobotConfig& config);

}  // namespace docent::modules
