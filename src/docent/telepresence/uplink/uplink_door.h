#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "docent/base/result.h"
#include "docent/telepresence/web_socket/web_socket.h"

namespace docent::telepresence {

/// A line without a byte for so long is given up: its gateway opens another one.
inline constexpr auto kSilentLine = std::chrono::seconds{6};

/// Where the line of a gateway far away comes in, on a port of its own: whoever does not prove that they hold the key
/// is sent away before a word of theirs is read. On the thread that runs `io`.
class UplinkDoor {
 public:
  /// A line whose other end holds the key, and from where it comes; its upgrade is still to be accepted.
  using Opened = std::function<void(std::unique_ptr<WebSocket> line, const std::string& address)>;

  UplinkDoor(boost::asio::io_context& io, WebSocketManner manner, Opened opened)
      : acceptor_{io}, pause_{io}, manner_{std::move(manner)}, opened_{std::move(opened)} {}
  UplinkDoor(const UplinkDoor&) = delete;
  UplinkDoor& operator=(const UplinkDoor&) = delete;

  /// Before `io` runs. Error: the port is taken.
  [[nodiscard]] Result<void> listen(const boost::asio::ip::tcp::endpoint& at, const std::string& key);
  [[nodiscard]] int port() const { return acceptor_.local_endpoint().port(); }

 private:
  void accept();
  void greet(boost::asio::ip::tcp::socket socket);

  boost::asio::ip::tcp::acceptor acceptor_;
  boost::asio::steady_timer pause_;
  const WebSocketManner manner_;
  const Opened opened_;
  std::shared_ptr<boost::asio::ssl::context> keys_;
  std::shared_ptr<int> greeted_ = std::make_shared<int>(0);  ///< that have not proved anything yet
};

/// Whether somebody else, too, holds the key of the line: they go on coming while one is in. Any thread.
class SecondHolder {
 public:
  using Clock = std::chrono::steady_clock;
  void sent_away(const std::string& address, Clock::time_point now);
  void came_in();
  /// From where they come; empty: nobody does, or they have not come for a minute.
  [[nodiscard]] std::string address(Clock::time_point now) const;

 private:
  mutable std::mutex mutex_;
  std::string address_;
  std::optional<Clock::time_point> since_;  ///< the first was sent away, of those since one came in
  Clock::time_point last_;
};

}  // namespace docent::telepresence
