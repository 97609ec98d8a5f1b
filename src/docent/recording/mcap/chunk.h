#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "docent/base/result.h"
#include "docent/recording/mcap/format.h"

namespace docent::recording::mcap {

/// The checksum of MCAP.
[[nodiscard]] std::uint32_t crc_of(std::span<const std::uint8_t> bytes);

/// One record and what follows it. `kind` 0: there is none that is whole.
struct Record {
  std::uint8_t kind = 0;
  std::span<const std::uint8_t> content;
  std::size_t size = 0;  ///< with its head
  [[nodiscard]] bool is(Kind other) const { return kind == static_cast<std::uint8_t>(other); }
};
/// The record that begins there.
[[nodiscard]] Record record_at(std::span<const std::uint8_t> bytes, std::size_t offset);

/// The records in a chunk, unpacked: plain, zstd or LZ4, of 256 MiB at most. Error: what is wrong with it.
/// @param content  of the chunk's record
[[nodiscard]] Result<std::vector<std::uint8_t>> unpack_chunk(std::span<const std::uint8_t> content);
/// Of a chunk that the end of the file cuts: what stands before the cut, the last of its records seldom whole. Error:
/// nothing of it can be read.
/// @param content  of the chunk's record, as far as it goes
[[nodiscard]] Result<std::vector<std::uint8_t>> unpack_cut_chunk(std::span<const std::uint8_t> content);

}  // namespace docent::recording::mcap
