#include <utility>  // first: Beast 1.74 forgets it in C++20
//
#include <algorithm>
#include <boost/beast/core/string.hpp>

#include "docent/telepresence/server/roles.h"

namespace docent::telepresence {

std::optional<Role> role_of(const Opening& opening, const std::vector<std::string>& others) {
  if (opening.origin.empty()) return Role::visitor;
  std::string_view page = opening.origin;
  for (const std::string_view scheme : {"http://", "https://"}) {
    if (page.starts_with(scheme)) {
      page.remove_prefix(scheme.size());
      break;
    }
  }
  const auto is_page_of = [page](std::string_view host) {
    return boost::beast::iequals({page.data(), page.size()}, {host.data(), host.size()});
  };
  if (is_page_of(opening.host) || std::any_of(others.begin(), others.end(), is_page_of)) return Role::visitor;
  return std::nullopt;
}

bool may_ask(Role role, const ClientMessage& message) {
  return role != Role::observer || std::holds_alternative<WatchMessage>(message);
}

}  // namespace docent::telepresence
