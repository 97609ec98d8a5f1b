#pragma once

#include <utility>  // first: Beast 1.74 forgets it in C++20
//
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <deque>
#include <functional>
#include <memory>
#include <string>

#include "docent/telepresence/foxglove/hub.h"

namespace docent::telepresence {

/// One client of the Foxglove protocol. Lives as long as an operation of its is under way.
class FoxgloveSession : public std::enable_shared_from_this<FoxgloveSession> {
 public:
  /// @param left  called once, when it has gone
  FoxgloveSession(FoxgloveHub& hub, boost::asio::ip::tcp::socket socket, std::function<void(FoxgloveSession*)> left);
  ~FoxgloveSession();
  FoxgloveSession(const FoxgloveSession&) = delete;
  FoxgloveSession& operator=(const FoxgloveSession&) = delete;

  /// Accepts the upgrade and tells what channels there are.
  void run(boost::beast::http::request<boost::beast::http::string_body> request);
  void add(std::uint32_t channel, Time time, const FoxgloveClient::Bytes& message);
  void drop() { boost::beast::get_lowest_layer(stream_).close(); }

 private:
  void read();
  void take();
  void flush();
  void say(std::string text);
  void leave();

  FoxgloveHub& hub_;
  std::function<void(FoxgloveSession*)> left_;
  FoxgloveClient client_;
  boost::beast::websocket::stream<boost::beast::tcp_stream, false> stream_;
  boost::beast::http::request<boost::beast::http::string_body> request_;
  boost::beast::flat_buffer buffer_;
  std::deque<std::string> texts_;  ///< still to be said, before messages
  std::string sending_;
  bool is_open_ = false;
  bool is_writing_ = false;
};

}  // namespace docent::telepresence
