#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "docent/telepresence/client_message.h"

namespace docent::telepresence {

/// As whom somebody is on the live channel.
enum class Role {
  observer,  ///< watches
  visitor,   ///< also makes wishes, takes them back, and answers questions
  staff,     ///< may ask for the same; nobody comes from the Web as staff
};

/// What a browser tells of itself when it opens the live channel.
struct Opening {
  std::string_view origin;  ///< whose page opens it; empty: not a browser
  std::string_view host;    ///< whom it calls
};

/// nullopt: it may not be opened, for a page of somebody else must not speak for its reader. Everybody else is a
/// visitor. @param others  hosts besides the called one whose pages may open it
[[nodiscard]] std::optional<Role> role_of(const Opening& opening, const std::vector<std::string>& others);

/// Whether somebody in this role may ask for it.
[[nodiscard]] bool may_ask(Role role, const ClientMessage& message);

}  // namespace docent::telepresence
