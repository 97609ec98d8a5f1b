#pragma once

#include "docent/modules/module.h"

namespace docent {

/// `localize`: the belief over the robot's place, its pose when it is sure of one, and the beams that the map does not
/// explain.
[[nodiscard]] Result<std::unique_ptr<Module>> make_localize(const ModuleContext& context);

}  // namespace docent
