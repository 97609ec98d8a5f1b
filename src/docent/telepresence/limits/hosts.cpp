#include "docent/telepresence/limits/hosts.h"

#include <arpa/inet.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>

namespace docent::telepresence {
namespace {

/// Empty or a colon and digits: what may stand behind a name.
bool is_port(std::string_view text) {
  return text.empty() || (text.front() == ':' && text.find_first_not_of("0123456789", 1) == std::string_view::npos);
}

/// In small letters, without its port and the dot at its end; empty: it is none.
std::string name_of(std::string_view host) {
  const auto bracket = host.find(']');
  const bool is_bracketed = host.starts_with('[') && bracket != std::string_view::npos;
  const auto end = is_bracketed ? bracket + 1 : std::min(host.find(':'), host.size());
  if (!is_port(host.substr(end))) return {};
  std::string name{is_bracketed ? host.substr(1, bracket - 1) : host.substr(0, end)};
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
  if (name.ends_with('.')) name.pop_back();
  return name;
}

bool is_address(const std::string& name) {
  std::array<unsigned char, 16> bytes{};
  return ::inet_pton(AF_INET, name.c_str(), bytes.data()) == 1 ||
         ::inet_pton(AF_INET6, name.c_str(), bytes.data()) == 1;
}

}  // namespace

Hosts::Hosts(const std::vector<std::string>& names) : names_{"localhost"} {
  for (const std::string& name : names) names_.insert(name_of(name));
  std::array<char, 256> own{};
  if (::gethostname(own.data(), own.size() - 1) != 0) return;
  const std::string name = name_of(own.data());
  if (name.empty()) return;
  names_.insert(name);
  names_.insert(name + ".local");
}

bool Hosts::is_ours(std::string_view host) const {
  if (host.empty()) return true;
  const std::string name = name_of(host);
  return names_.contains(name) || name.ends_with(".localhost") || is_address(name);
}

}  // namespace docent::telepresence
