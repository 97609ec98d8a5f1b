#pragma once

#include <utility>  // first: Beast 1.74 forgets it in C++20
//
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "docent/telepresence/web_socket/pre_shared_key.h"

namespace docent::telepresence {

using HttpRequest = boost::beast::http::request<boost::beast::http::string_body>;

/// How one end of a WebSocket behaves.
struct WebSocketManner {
  std::size_t longest_message = 65'536;  ///< [bytes] that may come; a longer one ends the connection
  std::chrono::milliseconds handshake_timeout = std::chrono::seconds{30};
  std::chrono::milliseconds idle_timeout = std::chrono::seconds{300};  ///< without a byte from the other end
  bool pings = true;                                                   ///< when half of that is over
  bool compresses = false;                                             ///< what it sends, if the other end agrees
  std::vector<std::string> protocols = {};                             ///< that a server speaks; empty: it names none
};

/// Of the sub-protocols that a client offers (Sec-WebSocket-Protocol), the first that a server speaks, for a client
/// names them in the order in which it wants them. Empty: it offers none. nullopt: none that the server speaks (RFC
/// 6455, 4.2.2: then the server names none, and a client that must have one fails; or the server refuses the upgrade).
[[nodiscard]] std::optional<std::string> agreed_protocol(const HttpRequest& request,
                                                         const std::vector<std::string>& spoken);

/// Why an end closes (RFC 6455, 7.4.1).
enum class CloseCode : std::uint16_t { unknown_data = 1003, policy_error = 1008 };

/// One end of a WebSocket, on a connected socket. All of it is used on the thread that runs the socket's context, which
/// also calls what is handed in, once each; one accept or greet, then one write and one read at a time. What has been
/// handed in lives until it was called.
class WebSocket {
 public:
  using Error = boost::system::error_code;
  using Done = std::function<void(Error)>;
  using Heard = std::function<void(Error, std::string message, bool is_text)>;

  WebSocket(boost::asio::ip::tcp::socket socket, const WebSocketManner& manner);
  /// On an encrypted line, which begins with `secure`.
  /// @param keys  see pre_shared
  WebSocket(boost::asio::ip::tcp::socket socket, const WebSocketManner& manner,
            std::shared_ptr<boost::asio::ssl::context> keys);

  /// Both ends prove to one another that they hold the same key. Error: one does not, or takes too long.
  void secure(bool is_server, Done done);
  /// A server's end accepts the upgrade that `request` asks for.
  void accept(HttpRequest request, Done done);
  /// Likewise, where nobody has read the request yet.
  void accept(Done done);
  /// A client's end asks for the upgrade. @param target  path and query
  void greet(const std::string& host, const std::string& target, Done done);
  /// @param message  stays where it is until it was sent
  void write(std::string_view message, bool is_text, Done done);
  void read(Heard heard);
  /// Says goodbye. @param reason  at most 123 bytes
  void close(CloseCode code, const std::string& reason, Done done);
  /// Ends the connection without a word; what is under way fails.
  void drop();

  [[nodiscard]] boost::asio::ip::tcp::socket::executor_type executor() const;
  /// The message that came was longer than it may be.
  [[nodiscard]] static bool is_too_long(const Error& error);

 private:
  class Stream;
  template <class Next>
  class StreamOn;
  std::shared_ptr<Stream> stream_;
};

}  // namespace docent::telepresence
