#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace docent::telepresence {

/// The first of `bytes` counts most. @pre at + kCount <= bytes.size()
template <std::size_t kCount>
[[nodiscard]] constexpr std::uint32_t big_endian(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < kCount; ++i) value = value << 8U | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

/// A number of SQLite's own kind, of 1 to 9 bytes. Moves `at` behind it. @returns false: it does not end
[[nodiscard]] constexpr bool take_varint(std::string_view bytes, std::size_t& at, std::uint64_t& value) {
  value = 0;
  for (int i = 0; i < 9; ++i) {
    if (at >= bytes.size()) return false;
    const auto byte = static_cast<unsigned char>(bytes[at++]);
    if (i == 8) {
      value = value << 8U | byte;
      return true;
    }
    value = value << 7U | (byte & 0x7FU);
    if ((byte & 0x80U) == 0) return true;
  }
  return true;
}

}  // namespace docent::telepresence
