#pragma once

#include <cstdint>
#include <filesystem>

#include "docent/base/result.h"
#include "docent/simulator/office/office.h"
#include "docent/simulator/world/survey.h"

namespace docent::simulator {

/// simulation.yaml of a world whose walls end at its ceiling; load_world reads the same world back, to the millimetre.
[[nodiscard]] std::string to_yaml(const World& world);

/// Writes a museum folder (architecture 5): the true world, and what a survey of it tells the robot. `docent check`
/// accepts it. Error: a file that cannot be written.
[[nodiscard]] Result<void> write_office(const Office& office, const Survey& survey, std::uint64_t seed,
                                        const std::filesystem::path& folder);

}  // namespace docent::simulator
