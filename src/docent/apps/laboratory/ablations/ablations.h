#pragma once

#include <string_view>

#include "docent/apps/laboratory/ablations/ablation_params.h"
#include "docent/apps/laboratory/ablations/altered_bus.h"
#include "docent/museum/museum.h"
#include "docent/robot/amendments.h"

namespace docent::apps::ablations {

/// What the switches change in parameters and memories.
[[nodiscard]] robot::Amendments amendments_of(const AblationParams& params);
/// What they change in the messages of a module.
[[nodiscard]] BusAlterations alterations_of(const AblationParams& params, std::string_view module);
/// Whether the module is to know no hazard of the museum and no border.
[[nodiscard]] bool ignores_hazards(const AblationParams& params, std::string_view module);
/// The museum as such a module knows it.
[[nodiscard]] museum::Museum without_hazards(museum::Museum museum);

}  // namespace docent::apps::ablations
