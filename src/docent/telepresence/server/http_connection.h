#pragma once

#include <utility>  // first: Beast 1.74 forgets it in C++20
//
#include <atomic>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

#include "docent/telepresence/server/router.h"

namespace docent::telepresence {

using HttpRequest = boost::beast::http::request<boost::beast::http::string_body>;

/// What all connections share with their server, which outlives them.
struct HttpOwner {
  std::function<Route(const RouteRequest&)> route;
  /// The connection becomes a session.
  std::function<void(boost::asio::ip::tcp::socket, HttpRequest, const OpenLive&)> open_live;
  std::function<void(boost::asio::ip::tcp::socket, HttpRequest)> open_foxglove;
  std::atomic<std::size_t>* connections = nullptr;
  std::atomic<std::uint64_t> requests{0};
};

/// One HTTP connection, until it is closed or becomes a session.
class HttpConnection : public std::enable_shared_from_this<HttpConnection> {
 public:
  HttpConnection(HttpOwner& owner, boost::asio::ip::tcp::socket socket) : owner_{owner}, stream_{std::move(socket)} {
    ++*owner_.connections;
  }
  ~HttpConnection() { --*owner_.connections; }
  HttpConnection(const HttpConnection&) = delete;
  HttpConnection& operator=(const HttpConnection&) = delete;

  void read();

 private:
  using Body = boost::beast::http::span_body<const char>;

  void serve();
  /// The other end is a program of this computer; a proxy says for whom it speaks.
  [[nodiscard]] bool is_local(const HttpRequest& request) const;
  void send(const HttpAnswer& answer, bool keep_alive, bool takes_gzip);

  HttpOwner& owner_;
  boost::beast::tcp_stream stream_;
  boost::beast::flat_buffer buffer_;
  std::optional<boost::beast::http::request_parser<boost::beast::http::string_body>> parser_;
  std::shared_ptr<const std::string> body_;
  std::optional<boost::beast::http::response<Body>> response_;
  std::optional<boost::beast::http::response_serializer<Body>> serializer_;
};

}  // namespace docent::telepresence
