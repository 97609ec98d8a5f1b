#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "docent/telepresence/server/roles.h"
#include "docent/telepresence/site.h"

namespace docent::telepresence {

/// What decides where a request goes.
struct RouteRequest {
  std::string_view method;  ///< GET, HEAD, …
  std::string_view target;
  bool is_upgrade = false;  ///< wants a WebSocket
  Opening opening;
  bool is_local = false;  ///< comes from this computer, and nobody has handed it on
};

/// The request is answered.
struct HttpAnswer {
  SiteReply reply;
  bool is_head = false;  ///< without the body
  bool is_last = false;  ///< and the connection is closed: it was refused
};
/// The connection becomes a session on the live channel.
struct OpenLive {
  Role role = Role::observer;
  bool is_thin = false;  ///< of what moves it wants the pose alone: /live?thin
};
/// The desk of /api/v1 answers (api/exchange).
struct CallApi {};
/// The connection becomes an operator's, if the desk admits them.
struct OpenOperate {};
/// The connection becomes a client of the Foxglove protocol.
struct OpenFoxglove {};
using Route = std::variant<HttpAnswer, OpenLive, OpenFoxglove, CallApi, OpenOperate>;

/// Paths to handlers: everything that can be fetched is the site's; /live is the channel of those who watch, /operate
/// that of operators; /api/v1 is answered by the desk; /foxglove, for programs of
/// this computer alone, shows all topics.
class Router {
 public:
  /// @param origins  hosts besides the server's own whose pages may open the live channel
  /// @param screen_key  see role_of; /live?screen=KEY
  Router(std::shared_ptr<const Site> site, std::vector<std::string> origins, std::string screen_key)
      : site_{std::move(site)}, origins_{std::move(origins)}, screen_key_{std::move(screen_key)} {}

  /// @param is_full  the live channel takes nobody more
  [[nodiscard]] Route route(const RouteRequest& request, bool is_full) const;

 private:
  std::shared_ptr<const Site> site_;
  std::vector<std::string> origins_;
  std::string screen_key_;
};

/// A few words of text, after which the connection is closed.
[[nodiscard]] HttpAnswer refusal(int status, std::string text);

}  // namespace docent::telepresence
