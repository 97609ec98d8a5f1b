#pragma once

#include <optional>
#include <string>
#include <string_view>

// Between a browser and the Web server there may be a proxy, which calls the server by another name and another path
// than the browser called the proxy.

namespace docent::telepresence {

/// What a proxy says of the browser for which it asks, as its headers came; empty: nothing. Where several proxies have
/// added to a list, the last word is that of the nearest, and all before it may be invented.
struct ForwardedHeaders {
  std::string_view address;  ///< X-Forwarded-For
  std::string_view host;     ///< X-Forwarded-Host
  std::string_view scheme;   ///< X-Forwarded-Proto
  std::string_view prefix;   ///< X-Forwarded-Prefix: the path that it has taken away
};

/// How a browser called the robot, and from where.
struct AsCalled {
  std::string address;
  std::string host;       ///< with its port, where that is not the scheme's own
  bool is_https = false;  ///< false: it did not, or nobody says
  std::string prefix;     ///< path of the site below which the page lies, such as "/robot"; empty: it is the site
};

/// @param is_believed  the peer is a proxy of ours
/// @param peer  address of the other end
/// @param host  of the header Host
[[nodiscard]] AsCalled as_called(const ForwardedHeaders& said, bool is_believed, std::string_view peer,
                                 std::string_view host);

/// True for "/robot", "/museum/robot" and the like: names of letters, digits and ".-_~" without "." and "..".
[[nodiscard]] bool is_path_prefix(std::string_view text);

/// What lies below the prefix: of "/robot/live?thin" and "/robot" it is "/live?thin". Empty: the prefix itself, which
/// lacks a "/" for its page to find its files. nullopt: it does not lie below it, or the prefix is empty.
[[nodiscard]] std::optional<std::string_view> below_prefix(std::string_view target, std::string_view prefix);

/// The header Set-Cookie of a server that is the whole site (`Path=/`), for a browser that called it so.
[[nodiscard]] std::string cookie_for(const AsCalled& called, std::string cookie);

}  // namespace docent::telepresence
