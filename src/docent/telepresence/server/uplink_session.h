#pragma once

#include <boost/asio/steady_timer.hpp>
#include <deque>
#include <functional>
#include <memory>
#include <string>

#include "docent/telepresence/server/session.h"
#include "docent/telepresence/site.h"
#include "docent/telepresence/uplink/envelope/envelope.h"
#include "docent/telepresence/uplink/envelope/picture_pieces.h"
#include "docent/telepresence/web_socket/web_socket.h"

namespace docent::telepresence {

/// Which bits of a ViewerId name the uplink that a viewer comes through; 0: none, they are here themselves.
inline constexpr unsigned kUplinkShift = 40;

/// What an uplink needs of its server, which outlives it.
struct UplinkOwner {
  std::function<void(const std::string& address)> arrived;
  std::function<void(std::uint64_t uplink)> left;
  std::shared_ptr<const Site> site;
  std::shared_ptr<ApiDesk> desk;
  std::atomic<int>* asked = nullptr;  ///< of the desk, and not yet answered
  std::atomic<bool>* is_closing = nullptr;
};

/// The line to a gateway far away, which serves a crowd from it: the newest value of each slot that a thin viewer gets,
/// the cameras' pictures in pieces that leave room for the rest, and what its viewers say. Lives as long as an
/// operation of its is under way.
class UplinkSession : public std::enable_shared_from_this<UplinkSession> {
 public:
  /// @param line  its other end has the key
  UplinkSession(SessionOwner& sessions, UplinkOwner& owner, const WebServerParams& params,
                std::unique_ptr<WebSocket> line, std::uint64_t number);
  /// How its line behaves.
  [[nodiscard]] static WebSocketManner manner();
  ~UplinkSession() { --sessions_.connections; }
  UplinkSession(const UplinkSession&) = delete;
  UplinkSession& operator=(const UplinkSession&) = delete;

  /// Accepts the upgrade and sends the `slots` (a bit each) that have a value.
  void run(std::uint32_t slots);
  /// The slot has a new value.
  void mark(std::size_t slot);
  /// To a viewer of the far gateway.
  void answer(std::uint64_t viewer, const std::string& text) { say(UplinkAnswer{viewer, text}); }
  void drop() { line_->drop(); }

 private:
  void read();
  void hear(ToMuseum message);
  void hear(const UplinkMessage& said);
  void hear(UplinkCall call);
  void say(const FromMuseum& message);
  /// Sends the next thing unless one is being sent.
  void flush();
  /// Every tenth of a second: some more of the pictures, and every few seconds new ones.
  void feed_pictures();
  [[nodiscard]] std::uint32_t wanted() const;
  void leave();

  SessionOwner& sessions_;
  UplinkOwner& owner_;
  const std::uint64_t number_;
  const double picture_s_;
  const std::size_t piece_bytes_;
  const std::unique_ptr<WebSocket> line_;  // with compression: it is thin
  boost::asio::steady_timer timer_;
  TokenBucket messages_, calls_, writes_;  ///< its share of this gateway
  std::uint32_t stale_ = 0;                ///< slots that have a newer value
  std::size_t last_slot_ = 0;
  std::deque<std::string> answers_;  ///< before slots
  PictureCutter robot_, scene_;
  std::string robot_taken_, scene_taken_;
  int ticks_ = 0;
  std::string sending_;
  bool is_open_ = false;
  bool is_writing_ = false;
};

}  // namespace docent::telepresence
