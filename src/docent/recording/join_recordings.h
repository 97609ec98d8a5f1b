#pragma once

#include <filesystem>
#include <set>
#include <vector>

#include "docent/base/result.h"

namespace docent::recording {

/// The recordings in a folder, finished or not, by the name that they have when they are finished. Empty: no folder.
[[nodiscard]] std::set<std::filesystem::path> recordings_in(const std::filesystem::path& folder);

/// Writes the messages of `files`, which follow one another in time, into one whole recording. A file that was cut
/// gives what can still be read of it. Error: none can be read, or `out` cannot be written.
[[nodiscard]] Result<void> join_recordings(const std::vector<std::filesystem::path>& files,
                                           const std::filesystem::path& out);

}  // namespace docent::recording
