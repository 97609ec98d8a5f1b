#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "docent/telepresence/foxglove/hub.h"
#include "docent/telepresence/web_socket/web_socket.h"

namespace docent::telepresence {

/// One client of the Foxglove protocol. Lives as long as an operation of its is under way.
class FoxgloveSession : public std::enable_shared_from_this<FoxgloveSession> {
 public:
  /// @param left  called once, when it has gone
  FoxgloveSession(FoxgloveHub& hub, boost::asio::ip::tcp::socket socket, std::function<void(FoxgloveSession*)> left);
  ~FoxgloveSession();
  FoxgloveSession(const FoxgloveSession&) = delete;
  FoxgloveSession& operator=(const FoxgloveSession&) = delete;

  /// The names of all that it speaks.
  [[nodiscard]] static std::vector<std::string> protocols();
  /// Accepts the upgrade and tells what channels there are.
  void run(HttpRequest request);
  void add(std::uint32_t channel, Time time, const FoxgloveClient::Bytes& message);
  void drop() { socket_.drop(); }

 private:
  void read();
  void take(const std::string& text, bool is_text);
  void flush();
  void say(std::string text);
  void leave();

  FoxgloveHub& hub_;
  std::function<void(FoxgloveSession*)> left_;
  FoxgloveClient client_;
  WebSocket socket_;
  std::deque<std::string> texts_;  ///< still to be said, before messages
  std::string sending_;
  bool is_open_ = false;
  bool is_writing_ = false;
};

}  // namespace docent::telepresence
