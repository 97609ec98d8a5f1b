#pragma once

#include <string>

namespace docent::telepresence {

/// Who counts as one caller: the address itself, but of IPv6 its first 64 bits, of which one household has all
/// addresses. A mapped IPv4 address is that IPv4 address. What is no address counts as it is written.
[[nodiscard]] std::string network_of(const std::string& address);

}  // namespace docent::telepresence
