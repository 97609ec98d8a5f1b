#pragma once

#include <string>

namespace docent::apps::config_command {

/// What the doc comment of a parameter struct says of a field, its unit in brackets first; empty: nothing.
[[nodiscard]] std::string meaning_of(const std::string& owner, const std::string& field);
/// What the doc comment of a parameter struct says of itself; empty: nothing.
[[nodiscard]] std::string meaning_of_struct(const std::string& owner);

}  // namespace docent::apps::config_command
