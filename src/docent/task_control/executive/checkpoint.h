#pragma once

#include <filesystem>

#include "docent/base/files.h"
#include "docent/base/result.h"
#include "docent/task_control/executive/executive.h"

namespace docent {

/// Writes the memory as JSON, atomically.
[[nodiscard]] Result<void> save_checkpoint(const std::filesystem::path& path, const ExecutiveMemory& memory,
                                           Survives survives = Survives::power_failure);
/// No file: a fresh memory. Error: "FILE: why" for a file that is damaged.
[[nodiscard]] Result<ExecutiveMemory> load_checkpoint(const std::filesystem::path& path);

}  // namespace docent
