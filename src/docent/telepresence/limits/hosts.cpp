#include "docent/telepresence/limits/hosts.h"

#include <arpa/inet.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>

namespace docent::telepresence {
namespace {

std::string without_port(std::string_view host) {
  const auto bracket = host.find(']');
  if (host.starts_with('[') && bracket != std::string_view::npos) return std::string{host.substr(1, bracket - 1)};
  return std::string{host.substr(0, host.find(':'))};
}

std::string name_of(std::string_view host) {
  std::string name = without_port(host);
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
