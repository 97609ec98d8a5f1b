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
  kiosk,  ///< the robot's own screen: like a visitor, says also which buttons are lit, what was answered to the poll,
          ///< and that somebody wants help
  staff,  ///< an operator, on /operate: stops the robot, steers it, says whose hours these are
};

/// What a browser tells of itself when it opens the live channel.
struct Opening {
  std::string_view origin;  ///< whose page opens it; empty: not a browser
  std::string_view host;    ///< whom it calls
  std::string_view key;     ///< with which a page says that it is the robot's own screen; empty: it does not say so
  bool is_https = false;    ///< it calls by https: a page that anybody on the way may have changed is not ours then
};

/// In the same time whatever the keys have in common; an empty one is none.
[[nodiscard]] bool is_same_key(std::string_view a, std::string_view b);

/// nullopt: it may not be opened, for a page of somebody else must not speak for its reader, and no page is the robot's
/// screen without its key. Everybody else is a visitor.
/// @param others  hosts besides the called one whose pages may open it
/// @param screen_key  of the robot's own screen; empty: it has none
[[nodiscard]] std::optional<Role> role_of(const Opening& opening, const std::vector<std::string>& others,
                                          std::string_view screen_key);

/// Whether somebody in this role may ask for it.
/// @param screen_stops  the robot's own screen may stop the robot; nobody but staff lets it go again
[[nodiscard]] bool may_ask(Role role, const ClientMessage& message, bool screen_stops);

}  // namespace docent::telepresence
