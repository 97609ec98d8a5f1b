#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "docent/base/result.h"

namespace docent::recording::mcap {

/// An LZ4 frame of that size, as chunks of MCAP and of ROS 1 bags hold it. Error: damaged, or of another size.
[[nodiscard]] Result<std::vector<std::uint8_t>> unpack_lz4(std::span<const std::uint8_t> packed, std::size_t size);
/// What a frame that was cut holds, up to the last whole block of it, at most `size` bytes.
[[nodiscard]] std::vector<std::uint8_t> unpack_cut_lz4(std::span<const std::uint8_t> packed, std::size_t size);

}  // namespace docent::recording::mcap
