#pragma once

#include <string>
#include <string_view>

namespace docent::transport {

/// SHA-256 (FIPS 180-4) of the bytes, as 64 hexadecimal digits. For names of types alone: nothing secret comes here,
/// and the bus shall need no library of cryptography.
[[nodiscard]] std::string sha256(std::string_view bytes);

}  // namespace docent::transport
