#pragma once

#include <cstdint>
#include <string>
#include <variant>

namespace docent::telepresence {

/// NULL, a whole number, a number, a text.
using Value = std::variant<std::monostate, std::int64_t, double, std::string>;

}  // namespace docent::telepresence
