#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "docent/base/result.h"

namespace docent {

/// The whole file. Error: "FILE: cannot be read: why".
[[nodiscard]] Result<std::string> read_file(const std::filesystem::path& path);

/// What a written file must outlive. A death of the process is survived without waiting for the disk.
enum class Survives { power_failure, process_death };

/// Writes beside `path`, syncs where asked, then renames: a reader sees the old file or the new one, never half of one.
[[nodiscard]] Result<void> write_file_atomically(const std::filesystem::path& path, std::string_view content,
                                                 Survives survives = Survives::power_failure);

/// Content of a gzip file, or of a plain one as it is. Error when the stream is damaged or larger than `limit` bytes.
[[nodiscard]] Result<std::string> read_maybe_gzipped(const std::filesystem::path& path,
                                                     std::size_t limit = std::size_t{4} << 30U);

}  // namespace docent
