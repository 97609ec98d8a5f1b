#include <utility>  // first: Beast 1.74 forgets it in C++20
//
#include <algorithm>
#include <array>
#include <boost/beast/core/string.hpp>

#include "docent/telepresence/server/roles.h"

namespace docent::telepresence {
namespace {

constexpr std::string_view kHttps = "https://";
constexpr std::array<std::pair<std::string_view, std::string_view>, 2> kSchemes{{{"http://", ":80"}, {kHttps, ":443"}}};

bool is_page_of_ours(const Opening& opening, const std::vector<std::string>& others) {
  if (opening.origin.empty()) return true;
  std::string_view page = opening.origin;
  std::string_view own_port;  // of the scheme: an origin does not name it, and a proxy may
  for (const auto& [scheme, port] : kSchemes) {
    if (!page.starts_with(scheme)) continue;
    page.remove_prefix(scheme.size());
    own_port = port;
    break;
  }
  const auto is_page_of = [page, own_port](std::string_view host) {
    if (!own_port.empty() && host.ends_with(own_port)) host.remove_suffix(own_port.size());
    return boost::beast::iequals({page.data(), page.size()}, {host.data(), host.size()});
  };
  const bool is_changeable = opening.is_https && !opening.origin.starts_with(kHttps);
  return (!is_changeable && is_page_of(opening.host)) || std::any_of(others.begin(), others.end(), is_page_of);
}

}  // namespace

bool is_same_key(std::string_view a, std::string_view b) {
  if (a.size() != b.size() || b.empty()) return false;
  unsigned difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i) difference |= static_cast<unsigned>(a[i] ^ b[i]);
  return difference == 0;
}

std::optional<Role> role_of(const Opening& opening, const std::vector<std::string>& others,
                            std::string_view screen_key) {
  if (!is_page_of_ours(opening, others)) return std::nullopt;
  if (opening.key.empty()) return Role::visitor;
  return is_same_key(opening.key, screen_key) ? std::optional{Role::kiosk} : std::nullopt;
}

bool may_ask(Role role, const ClientMessage& message, bool screen_stops) {
  if (std::holds_alternative<WatchMessage>(message)) return true;
  const auto* stop = std::get_if<StopMessage>(&message);
  if (role == Role::kiosk && screen_stops && stop != nullptr && stop->stopped) return true;
  const bool is_of_the_screen =
      std::holds_alternative<LampsMessage>(message) || std::holds_alternative<HelpMessage>(message) ||
      std::holds_alternative<SkipMessage>(message) || std::holds_alternative<AnswerMessage>(message);
  const bool is_of_staff =
      std::holds_alternative<LeaseMessage>(message) || std::holds_alternative<SteerMessage>(message) ||
      std::holds_alternative<StopMessage>(message) || std::holds_alternative<SetHoursMessage>(message);
  if (is_of_staff) return role == Role::staff;
  return is_of_the_screen ? role == Role::kiosk : role != Role::observer;
}

}  // namespace docent::telepresence
