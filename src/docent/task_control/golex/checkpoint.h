#pragma once

#include <filesystem>
#include <string>

#include "docent/base/files.h"
#include "docent/base/result.h"
#include "docent/task_control/golex/executive.h"

namespace docent::task_control {

/// Writes the memory as JSON, atomically. `map` names the map that its poses lie in.
[[nodiscard]] Result<void> save_checkpoint(const std::filesystem::path& path, const ExecutiveMemory& memory,
                                           const std::string& map, Survives survives = Survives::power_failure);
/// No file, or one of another map: a fresh memory. Error: "FILE: why" for a file that is damaged.
[[nodiscard]] Result<ExecutiveMemory> load_checkpoint(const std::filesystem::path& path, const std::string& map);

}  // namespace docent::task_control
