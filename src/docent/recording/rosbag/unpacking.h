#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "docent/base/result.h"

namespace docent::recording {

/// The whole of what was packed, where nobody says how large it is. Error: damaged, or larger than a gigabyte.
[[nodiscard]] Result<std::vector<std::uint8_t>> unpack_zstd(std::span<const std::uint8_t> packed);
/// Likewise of a block whose size is known.
[[nodiscard]] Result<std::vector<std::uint8_t>> unpack_bz2(std::span<const std::uint8_t> packed, std::size_t size);
/// What stands before the end of a block that was cut, at most `size` bytes.
[[nodiscard]] std::vector<std::uint8_t> unpack_cut_bz2(std::span<const std::uint8_t> packed, std::size_t size);
/// Unpacks a file into another, piece by piece. Error: "PACKED: …"; what came before a damage stays in `to`.
[[nodiscard]] Result<void> unpack_zstd_file(const std::filesystem::path& packed, const std::filesystem::path& to);
/// Whether these bytes begin as zstd's frames do; no CDR message does.
[[nodiscard]] bool is_zstd(std::span<const std::uint8_t> bytes);

}  // namespace docent::recording
