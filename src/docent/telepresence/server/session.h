#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "docent/telepresence/limits/place.h"
#include "docent/telepresence/limits/rate_limits.h"
#include "docent/telepresence/server/roles.h"
#include "docent/telepresence/server/viewer_queue.h"
#include "docent/telepresence/server/web_server.h"
#include "docent/telepresence/web_socket/web_socket.h"

namespace docent::telepresence {

/// What all sessions share with their server, which outlives them.
struct SessionOwner {
  std::function<void(const Caller&, const ClientMessage&)> message;
  std::function<void(const Caller&)> left;
  std::function<SharedText(std::size_t slot)> latest;  ///< null: it has no value yet
  // A bit for each slot that only some viewers get (Stream).
  std::uint32_t detail_slots = 0;
  std::uint32_t full_slots = 0;
  std::uint32_t thin_slots = 0;
  std::uint32_t operator_slots = 0;
  std::uint32_t stop_slots = 0;
  bool screen_stops = false;             ///< see WebServerParams
  RateLimits of_address{{20.0, 200.0}};  ///< of what visitors send, by their network
  std::atomic<std::size_t> connections{0};
  std::atomic<std::uint64_t> messages_in{0}, messages_refused{0}, messages_out{0}, values_skipped{0};
};

/// One viewer: their WebSocket, what they have still to get, and what they may send. Lives as long as an operation of
/// its is under way.
class Session : public std::enable_shared_from_this<Session> {
 public:
  /// @param place  see Place; held as long as the session lasts
  Session(SessionOwner& owner, const WebServerParams& params, boost::asio::ip::tcp::socket socket, Caller caller,
          bool must_be_thin, std::shared_ptr<Place> place = {});
  ~Session() { --owner_.connections; }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// Accepts the upgrade and sends the `slots` (a bit each) that have a value.
  /// @param is_thin  it asks for the pose alone of what moves
  void run(HttpRequest request, std::uint32_t slots, bool is_thin);
  /// The slot has a new value.
  void mark(std::size_t slot);
  void answer(SharedText text);
  /// Sends the next thing unless one is being sent.
  void flush();
  void drop() { socket_.drop(); }
  /// Whether it came with that login of an operator.
  [[nodiscard]] bool is_of(const std::string& login) const { return !login.empty() && caller_.login == login; }
  /// Whoever it is has gone, as far as the robot is concerned; what they still send is not heard.
  void end(const std::string& why);

 private:
  void read();
  [[nodiscard]] bool is_within_rate();
  void watch(const WatchMessage& wish);
  /// Which slots it gets.
  [[nodiscard]] std::uint32_t wanted() const;
  void take(const std::string& text, bool is_text);
  void refuse(CloseCode code, const std::string& reason);
  void close(CloseCode code, const std::string& reason);
  void leave();

  SessionOwner& owner_;
  const Caller caller_;
  const std::string network_;
  const std::shared_ptr<Place> place_;
  TokenBucket bucket_;
  WebSocket socket_;
  ViewerQueue queue_;
  SharedText sending_;
  int too_many_ = 0;
  bool is_open_ = false;
  bool is_writing_ = false;
  bool is_closing_ = false;
  bool wants_details_ = false;
  bool must_be_thin_;
  bool is_thin_ = false;
};

}  // namespace docent::telepresence
