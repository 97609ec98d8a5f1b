#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "docent/base/result.h"

namespace docent::telepresence {

/// Readable for its owner alone; the old file or the new one, never half of one; on the disk when it returns.
[[nodiscard]] Result<void> write_private_file(const std::filesystem::path& file, std::string_view content);
/// Takes everybody else's rights off a file or folder, where it is there; what root makes belongs to whom its folder
/// does.
void make_private(const std::filesystem::path& path);
/// On the disk, whatever becomes of the power: a file, or which files a folder has.
[[nodiscard]] Result<void> sync_to_disk(const std::filesystem::path& path);
/// On the disk under its other name.
[[nodiscard]] Result<void> rename_for_good(const std::filesystem::path& from, const std::filesystem::path& to);
/// A name that no file has yet: BESIDE.WHY-20261129T170302Z
[[nodiscard]] std::filesystem::path dated_name(const std::filesystem::path& beside, const std::string& why);
/// [s] since 1970.
[[nodiscard]] std::int64_t seconds_now();
/// 2026-11-29 17:03:02 UTC
[[nodiscard]] std::string date_and_time(std::int64_t seconds);

}  // namespace docent::telepresence
