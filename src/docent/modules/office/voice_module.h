#pragma once

#include "docent/modules/shared/module.h"

namespace docent::modules {

/// `voice`: commands that are spoken after a press of a button, in English: exhibits, tours and rooms, deliveries,
/// tidying up. What it has understood it says to others as a button or the page would.
[[nodiscard]] Result<std::unique_ptr<Module>> make_voice(const ModuleContext& context);
[[nodiscard]] Result<robot::ParameterRows> parameters_of_voice(const robot::RobotConfig& config);

}  // namespace docent::modules
