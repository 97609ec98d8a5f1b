#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/telepresence/client_message.h"
#include "docent/telepresence/server/roles.h"
#include "docent/telepresence/site.h"

namespace docent::telepresence {

struct WebServerParams {
  std::string address = "127.0.0.1";  ///< that the server listens at; 0.0.0.0: all of this computer
  int port = 8080;                    ///< 0: any free one, see WebServer::port
  int max_connections = 12000;        ///< all kinds together
  int max_viewers = 10000;            ///< on the live channel
  int foxglove_clients = 4;           ///< at /foxglove, from this computer alone; 0: nobody
  bool foxglove_by_proxy = false;     ///< also those whom a proxy of `proxies` hands on: it must say who may look in
  int full_viewers = 200;             ///< who get more than the pose of what moves; who comes later gets the pose alone
  double messages_per_second = 2.0;   ///< of one viewer, sustained
  double message_burst = 20.0;        ///< of one viewer
  double steering_per_second = 30.0;  ///< messages of one operator
  int max_message_bytes = 4096;       ///< a longer one ends the connection
  int send_buffer_bytes = 65536;      ///< of the kernel, for one connection: small, so that old values do not pile up
  int uplink_port = 0;                ///< where an encrypted line to a gateway far away comes in; 0: there is none
  double uplink_picture_s = 5.0;      ///< between two pictures of a camera for a gateway far away
  int uplink_picture_bytes_per_s = 12000;     ///< of its line, for pictures
  double uplink_messages_per_second = 150.0;  ///< of all who come through the line, whatever its other end says of them
  double uplink_calls_per_second = 50.0;      ///< likewise, of calls to /api/v1
  double uplink_writes_per_second = 10.0;     ///< likewise, of those calls that change something
  double idle_timeout_s = 30.0;               ///< a viewer who answers no ping for so long is gone
  int connections_of_address = 1000;          ///< that are not of this computer; more are closed
  double messages_of_address = 20.0;          ///< per second, of all visitors who come from one address
  double message_burst_of_address = 200.0;    ///< likewise at once
  bool screen_stops = false;  ///< the robot's own screen has a button that stops it; staff let it go on, on /operate
  std::vector<std::string> hosts;    ///< names by which the server may be called, besides localhost, addresses and
                                     ///< the computer's own; behind a proxy that passes on Host: the public name
  std::vector<std::string> origins;  ///< hosts besides the server's own whose pages may open the live channel
  std::vector<std::string> proxies;  ///< addresses of proxies of ours: what they say of the caller (X-Forwarded-For,
                                     ///< -Host, -Proto, -Prefix) is believed
  std::string prefix;                ///< path below which a proxy shows the page and which it passes on, such as
                                     ///< /robot; empty: it takes the path away, or there is none
  template <class V>
  void visit(V& v) {
    v("address", address);
    v("port", port);
    v("max_connections", max_connections);
    v("max_viewers", max_viewers);
    v("foxglove_clients", foxglove_clients);
    v("foxglove_by_proxy", foxglove_by_proxy);
    v("full_viewers", full_viewers);
    v("messages_per_second", messages_per_second);
    v("message_burst", message_burst);
    v("steering_per_second", steering_per_second);
    v("max_message_bytes", max_message_bytes);
    v("send_buffer_bytes", send_buffer_bytes);
    v("uplink_port", uplink_port);
    v("uplink_picture_s", uplink_picture_s);
    v("uplink_picture_bytes_per_s", uplink_picture_bytes_per_s);
    v("uplink_messages_per_second", uplink_messages_per_second);
    v("uplink_calls_per_second", uplink_calls_per_second);
    v("uplink_writes_per_second", uplink_writes_per_second);
    v("idle_timeout_s", idle_timeout_s);
    v("connections_of_address", connections_of_address);
    v("messages_of_address", messages_of_address);
    v("message_burst_of_address", message_burst_of_address);
    v("screen_stops", screen_stops);
    v("hosts", hosts);
    v("origins", origins);
    v("proxies", proxies);
    v("prefix", prefix);
  }
  [[nodiscard]] Result<void> validate() const;
};

using ViewerId = std::uint64_t;

/// Somebody who sends a message.
struct Caller {
  ViewerId id = 0;
  Role role = Role::observer;
  std::string name;          ///< an operator's
  std::string login = {};    ///< likewise, which of their logins
  std::string address = {};  ///< from where they come
};

/// To whom a slot is sent: everybody but operators' own connections; who asked for details; who gets all that moves;
/// who gets the pose alone; operators; operators and the robot's own screen, where it has a button that stops the
/// robot.
enum class Stream { everybody, details, full, thin, operators, stop };

class ApiDesk;
class FoxgloveHub;

/// What a server is for. All of it is called on the server's thread and must not block.
struct WebServerHooks {
  std::function<void(const Caller&, const ClientMessage&)> message;
  std::function<void(const std::string& address)> arrived = {};  ///< somebody opened the live channel
  std::function<void(const Caller&)> left = {};                  ///< an operator is gone
  std::string screen_key = {};  ///< with which the robot's own screen comes; empty: it has none
  std::string uplink_key = {};  ///< of a gateway far away, at params.uplink_port; empty: there may be none
  std::shared_ptr<FoxgloveHub> foxglove = {};  ///< what it shows at /foxglove; null: nothing
  std::shared_ptr<ApiDesk> desk = {};          ///< who answers /api/v1 and admits operators; null: nobody
};

struct WebServerFigures {
  std::size_t connections = 0;
  std::size_t viewers = 0;
  std::uint64_t viewers_ever = 0;
  std::uint64_t http_requests = 0;
  std::uint64_t messages_in = 0;
  std::uint64_t messages_refused = 0;  ///< malformed, or too many
  std::uint64_t messages_out = 0;
  std::uint64_t values_skipped = 0;  ///< newer values took their place before a slow viewer was ready
};

/// HTTP for the site, WebSocket on /live for viewers; one thread of its own.
///
/// What is shown is a set of slots, each with one latest value, encoded once for all. A viewer gets every slot on
/// arrival and then the changes; one who is slow gets the latest value of a slot and never a queue of old ones, so
/// the memory for a viewer is bounded. With many viewers the sends are spread over ten groups.
class WebServer {
 public:
  static constexpr int kSlots = 24;
  static constexpr int kParts = 10;  ///< of all viewers

  /// Error: "ADDRESS:PORT: why", for instance because another program has the port.
  [[nodiscard]] static Result<std::unique_ptr<WebServer>> start(const WebServerParams& params,
                                                                std::shared_ptr<const Site> site, WebServerHooks hooks);
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;
  ~WebServer();  ///< closes everything and ends the thread

  /// From where a second holder of the uplink's key comes; empty: nobody does. Any thread.
  [[nodiscard]] std::string second_holder() const;
  [[nodiscard]] int port() const;
  /// Any thread: the new value of a slot, for all viewers. @pre 0 <= slot < kSlots
  void broadcast(int slot, std::string text);
  /// Any thread: the new value of a slot, at once for the viewers of one of `kParts` parts. Whoever calls it for one
  /// part after the other, each with the newest value, spares the server a burst and its viewers the wait for its end.
  /// @pre 0 <= part < kParts
  void broadcast_part(int slot, int part, std::string text);
  /// From now on the slot is only sent to these viewers.
  void restrict_to(Stream stream, int slot);
  /// Any thread: an answer to one viewer. One who leaves too many unread is cut off.
  void send(ViewerId viewer, std::string text);
  /// Any thread: a message of a channel for the Foxglove clients that have subscribed to it.
  void show(std::uint32_t channel, Time time, std::shared_ptr<const std::vector<std::uint8_t>> message);
  [[nodiscard]] WebServerFigures figures() const;

 private:
  struct Core;
  explicit WebServer(std::unique_ptr<Core> core);
  std::unique_ptr<Core> core_;
};

}  // namespace docent::telepresence
