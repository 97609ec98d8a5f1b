#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace docent::telepresence {

/// RFC 4648, 4, with padding.
[[nodiscard]] std::string base64(const std::vector<std::uint8_t>& bytes);

}  // namespace docent::telepresence
