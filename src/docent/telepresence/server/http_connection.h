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

#include "docent/telepresence/api/exchange/exchange.h"
#include "docent/telepresence/api/exchange/forwarding.h"
#include "docent/telepresence/limits/hosts.h"
#include "docent/telepresence/limits/place.h"
#include "docent/telepresence/server/router.h"
#include "docent/telepresence/web_socket/web_socket.h"

namespace docent::telepresence {

/// As whom, and from where, a connection becomes a session.
struct Arrival {
  Role role = Role::observer;
  bool is_thin = false;  ///< of what moves it wants the pose alone
  std::string address;
  std::string name;   ///< an operator's
  std::string login;  ///< likewise, which of their logins
  std::shared_ptr<Place> place;
};

/// What all connections share with their server, which outlives them.
struct HttpOwner {
  std::function<Route(const RouteRequest&)> route;
  /// The connection becomes a session.
  std::function<void(boost::asio::ip::tcp::socket, HttpRequest, const Arrival&)> open_live;
  std::function<void(boost::asio::ip::tcp::socket, HttpRequest)> open_foxglove;
  std::shared_ptr<ApiDesk> desk;  ///< null: there is no /api/v1
  /// A place among those of that address; null: it has none left.
  std::function<std::shared_ptr<Place>(const std::string& address)> take_place;
  std::vector<std::string> proxies;        ///< addresses whose X-Forwarded-… is believed
  std::vector<std::string> origins;        ///< see role_of
  std::string prefix;                      ///< below which the page may be asked for, too; empty: nowhere else
  bool shows_foxglove_to_proxies = false;  ///< and not to programs of this computer alone
  Hosts hosts{{}};
  std::atomic<int> asked{0};             ///< of the desk, and not yet answered
  std::atomic<bool> is_closing = false;  ///< the desk is asked no more
  std::atomic<std::size_t>* connections = nullptr;
  int large_bodies = 0;  ///< that are being read; the server's thread alone
  std::atomic<std::uint64_t> requests{0};
};

/// One HTTP connection, until it is closed or becomes a session.
class HttpConnection : public std::enable_shared_from_this<HttpConnection> {
 public:
  /// @param place  null: it is of this computer, or a proxy's
  HttpConnection(HttpOwner& owner, boost::asio::ip::tcp::socket socket, std::shared_ptr<Place> place)
      : owner_{owner}, stream_{std::move(socket)}, place_{std::move(place)} {
    ++*owner_.connections;
    boost::beast::error_code error;
    const auto peer = stream_.socket().remote_endpoint(error);
    if (error) return;
    peer_ = peer.address().to_string();
    is_peer_here_ = peer.address().is_loopback();
  }
  ~HttpConnection() { --*owner_.connections; }
  HttpConnection(const HttpConnection&) = delete;
  HttpConnection& operator=(const HttpConnection&) = delete;

  void read();

 private:
  using Body = boost::beast::http::span_body<const char>;

  /// Holds a place among the few large bodies.
  struct LargeBody {
    explicit LargeBody(int& all) : count{all} { ++count; }
    LargeBody(const LargeBody&) = delete;
    LargeBody& operator=(const LargeBody&) = delete;
    ~LargeBody() { --count; }
    int& count;
  };

  void look_at_header();
  /// Takes what a proxy says for granted, and the prefix away from the target; false: the prefix is all there is.
  [[nodiscard]] bool understand_call();
  void read_large_body();
  void read_body();
  void complain(boost::beast::error_code error);
  void serve();
  /// Has the desk answer.
  void call_api(const HttpRequest& request);
  void admit(HttpRequest request);
  /// Takes what the desk has to say back to the server's thread.
  template <class Answer, class Then>
  auto when_answered(Then then);
  [[nodiscard]] Opening opening_of(const HttpRequest& request) const;
  [[nodiscard]] bool is_proxy(const std::string& address) const;
  /// Called by a name of ours, or by a proxy of ours, which knows its own.
  [[nodiscard]] bool is_called_rightly(const HttpRequest& request) const;
  /// The other end is a program of this computer; a proxy says for whom it speaks.
  [[nodiscard]] bool is_local(const HttpRequest& request) const;
  void send(const HttpAnswer& answer, bool keep_alive, bool takes_gzip);
  void send(ApiReply reply, bool keep_alive);
  void send_to_page(bool keep_alive);
  void set_common_headers();
  void write(bool is_head, bool keep_alive);

  HttpOwner& owner_;
  boost::beast::tcp_stream stream_;
  std::shared_ptr<Place> place_;
  std::string peer_;           ///< address of the other end; empty: it had gone at once
  bool is_peer_here_ = false;  ///< it is on this computer
  boost::beast::flat_buffer buffer_;
  std::optional<boost::beast::http::request_parser<boost::beast::http::string_body>> parser_;
  AsCalled called_;  ///< of the request that is being answered
  std::optional<LargeBody> large_body_;
  std::shared_ptr<const std::string> body_;
  std::optional<boost::beast::http::response<Body>> response_;
  std::optional<boost::beast::http::response_serializer<Body>> serializer_;
};

}  // namespace docent::telepresence
