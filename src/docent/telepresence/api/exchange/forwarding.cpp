#include "docent/telepresence/api/exchange/forwarding.h"

#include <algorithm>
#include <cctype>

namespace docent::telepresence {
namespace {

constexpr std::size_t kLongestAddress = 45;  // bytes: an IPv6 address with an IPv4 one in it
constexpr std::size_t kLongestHost = 261;    // bytes: a name, a colon and a port
constexpr std::size_t kLongestPrefix = 200;  // bytes: a cookie's path has room for it in every browser

/// The last of a list, without the spaces around it.
std::string_view nearest(std::string_view list) {
  const auto comma = list.rfind(',');
  if (comma != std::string_view::npos) list.remove_prefix(comma + 1);
  const auto first = list.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return list.substr(first, list.find_last_not_of(" \t") - first + 1);
}

bool is_letter_or_digit(char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

/// Of nothing but letters, digits and these.
bool is_made_of(std::string_view text, std::string_view others) {
  return std::all_of(text.begin(), text.end(),
                     [others](char c) { return is_letter_or_digit(c) || others.find(c) != std::string_view::npos; });
}

bool is_address(std::string_view text) {
  return !text.empty() && text.size() <= kLongestAddress &&
         text.find_first_not_of("0123456789abcdefABCDEF.:") == std::string_view::npos;
}

bool is_host(std::string_view text) {
  return !text.empty() && text.size() <= kLongestHost && is_made_of(text, ".-_:[]");
}

std::string in_small_letters(std::string_view text) {
  std::string small{text};
  std::transform(small.begin(), small.end(), small.begin(), [](unsigned char c) { return std::tolower(c); });
  return small;
}

}  // namespace

bool is_path_prefix(std::string_view text) {
  if (!text.starts_with('/') || text.size() > kLongestPrefix) return false;
  while (!text.empty()) {  // one name after the other, each with its "/"
    text.remove_prefix(1);
    const std::string_view name = text.substr(0, text.find('/'));
    if (name.empty() || name == "." || name == ".." || !is_made_of(name, ".-_~")) return false;
    text.remove_prefix(name.size());
  }
  return true;
}

AsCalled as_called(const ForwardedHeaders& said, bool is_believed, std::string_view peer, std::string_view host) {
  AsCalled called{std::string{peer}, std::string{host}, false, {}};
  if (!is_believed) return called;
  if (const auto address = nearest(said.address); is_address(address)) called.address = address;
  if (const auto name = nearest(said.host); is_host(name)) called.host = name;
  const std::string scheme = in_small_letters(nearest(said.scheme));
  called.is_https = scheme == "https" || scheme == "wss";  // some name the scheme of a WebSocket
  std::string_view prefix = nearest(said.prefix);
  if (prefix.ends_with('/')) prefix.remove_suffix(1);
  if (is_path_prefix(prefix)) called.prefix = prefix;
  return called;
}

std::optional<std::string_view> below_prefix(std::string_view target, std::string_view prefix) {
  if (prefix.empty() || !target.starts_with(prefix)) return std::nullopt;
  target.remove_prefix(prefix.size());
  if (target.empty() || target.front() == '?') return std::string_view{};
  return target.front() == '/' ? std::optional{target} : std::nullopt;
}

std::string cookie_for(const AsCalled& called, std::string cookie) {
  constexpr std::string_view kWholeSite = "; Path=/;";
  const auto place = cookie.find(kWholeSite);
  if (!called.prefix.empty() && place != std::string::npos) {
    cookie.insert(place + kWholeSite.size() - 1, called.prefix.substr(1) + "/");
  }
  if (called.is_https && cookie.find("; Secure") == std::string::npos) cookie += "; Secure";
  return cookie;
}

}  // namespace docent::telepresence
