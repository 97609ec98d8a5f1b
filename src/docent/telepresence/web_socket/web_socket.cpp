#include "docent/telepresence/web_socket/web_socket.h"

#include <algorithm>
#include <boost/asio/ssl.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/ssl.hpp>
#include <boost/beast/websocket.hpp>
#include <boost/beast/websocket/ssl.hpp>
#include <type_traits>

#include "docent/base/check.h"

namespace docent::telepresence {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using asio::ip::tcp;

std::optional<std::string> agreed_protocol(const HttpRequest& request, const std::vector<std::string>& spoken) {
  bool offers_one = false;
  const auto [first, end] = request.equal_range(http::field::sec_websocket_protocol);
  for (auto line = first; line != end; ++line) {
    for (const auto& offered : http::token_list{line->value()}) {
      offers_one = true;
      const auto same = std::find(spoken.begin(), spoken.end(), std::string{offered.data(), offered.size()});
      if (same != spoken.end()) return *same;
    }
  }
  return offers_one ? std::nullopt : std::optional{std::string{}};
}

/// What a line can do, whatever it runs on.
class WebSocket::Stream : public std::enable_shared_from_this<Stream> {
 public:
  Stream() = default;
  Stream(const Stream&) = delete;
  Stream& operator=(const Stream&) = delete;
  virtual ~Stream() = default;
  virtual void secure(bool is_server, std::chrono::milliseconds patience, Done done) = 0;
  virtual void accept(HttpRequest request, Done done) = 0;
  virtual void accept(Done done) = 0;
  virtual void greet(const std::string& host, const std::string& target, Done done) = 0;
  virtual void write(std::string_view message, bool is_text, Done done) = 0;
  virtual void read(Heard heard) = 0;
  virtual void close(const websocket::close_reason& reason, Done done) = 0;
  virtual void drop() = 0;
  virtual tcp::socket::executor_type executor() = 0;
};

template <class Next>
class WebSocket::StreamOn final : public Stream {
 public:
  template <class... Parts>
  explicit StreamOn(std::shared_ptr<asio::ssl::context> keys, const WebSocketManner& manner, Parts&&... parts)
      : keys_{std::move(keys)}, protocols_{manner.protocols}, websocket_{std::forward<Parts>(parts)...} {
    websocket::stream_base::timeout timeout{};
    timeout.handshake_timeout = manner.handshake_timeout;
    timeout.idle_timeout = manner.idle_timeout;
    timeout.keep_alive_pings = manner.pings;
    websocket_.set_option(timeout);
    websocket::permessage_deflate deflate;
    deflate.server_enable = deflate.client_enable = manner.compresses;
    websocket_.set_option(deflate);
    websocket_.read_message_max(manner.longest_message);
    websocket_.auto_fragment(false);
  }

  void secure(bool is_server, std::chrono::milliseconds patience, Done done) override {
    if constexpr (std::is_same_v<Next, beast::ssl_stream<beast::tcp_stream>>) {
      beast::get_lowest_layer(websocket_).expires_after(patience);
      websocket_.next_layer().async_handshake(
          is_server ? asio::ssl::stream_base::server : asio::ssl::stream_base::client,
          [this, self = shared_from_this(), done = std::move(done)](Error error) {
            beast::get_lowest_layer(websocket_).expires_never();
            done(error);
          });
    } else {
      DOCENT_CHECK(false);
    }
  }
  void accept(HttpRequest request, Done done) override {
    request_ = std::move(request);
    if (const auto protocol = agreed_protocol(request_, protocols_); protocol && !protocol->empty()) {
      websocket_.set_option(websocket::stream_base::decorator([name = *protocol](websocket::response_type& response) {
        response.set(http::field::sec_websocket_protocol, name);
      }));
    }
    websocket_.async_accept(request_, [this, self = shared_from_this(), done = std::move(done)](Error error) {
      request_ = {};
      done(error);
    });
  }
  void accept(Done done) override {
    websocket_.async_accept([self = shared_from_this(), done = std::move(done)](Error error) { done(error); });
  }
  void greet(const std::string& host, const std::string& target, Done done) override {
    websocket_.async_handshake(host, target,
                               [self = shared_from_this(), done = std::move(done)](Error error) { done(error); });
  }
  void write(std::string_view message, bool is_text, Done done) override {
    websocket_.text(is_text);
    websocket_.async_write(
        asio::buffer(message.data(), message.size()),
        [self = shared_from_this(), done = std::move(done)](Error error, std::size_t) { done(error); });
  }
  void read(Heard heard) override {
    websocket_.async_read(buffer_,
                          [this, self = shared_from_this(), heard = std::move(heard)](Error error, std::size_t) {
                            std::string message = beast::buffers_to_string(buffer_.data());
                            buffer_.consume(buffer_.size());
                            heard(error, std::move(message), !websocket_.got_binary());
                          });
  }
  void close(const websocket::close_reason& reason, Done done) override {
    websocket_.async_close(reason, [self = shared_from_this(), done = std::move(done)](Error error) { done(error); });
  }
  void drop() override { beast::get_lowest_layer(websocket_).close(); }
  tcp::socket::executor_type executor() override { return websocket_.get_executor(); }

 private:
  const std::shared_ptr<asio::ssl::context> keys_;  ///< outlives the stream
  const std::vector<std::string> protocols_;        ///< that it speaks
  websocket::stream<Next> websocket_;
  beast::flat_buffer buffer_;
  HttpRequest request_;  ///< until it is accepted
};

WebSocket::WebSocket(tcp::socket socket, const WebSocketManner& manner)
    : stream_{std::make_shared<StreamOn<beast::tcp_stream>>(nullptr, manner, std::move(socket))} {}

WebSocket::WebSocket(tcp::socket socket, const WebSocketManner& manner, std::shared_ptr<asio::ssl::context> keys)
    : stream_{
          std::make_shared<StreamOn<beast::ssl_stream<beast::tcp_stream>>>(keys, manner, std::move(socket), *keys)} {}

void WebSocket::secure(bool is_server, Done done) {
  constexpr auto kPatience = std::chrono::seconds{10};
  stream_->secure(is_server, kPatience, std::move(done));
}

void WebSocket::accept(HttpRequest request, Done done) { stream_->accept(std::move(request), std::move(done)); }

void WebSocket::accept(Done done) { stream_->accept(std::move(done)); }

void WebSocket::greet(const std::string& host, const std::string& target, Done done) {
  stream_->greet(host, target, std::move(done));
}

void WebSocket::write(std::string_view message, bool is_text, Done done) {
  stream_->write(message, is_text, std::move(done));
}

void WebSocket::read(Heard heard) { stream_->read(std::move(heard)); }

void WebSocket::close(CloseCode code, const std::string& reason, Done done) {
  stream_->close({static_cast<websocket::close_code>(code), {reason.data(), reason.size()}}, std::move(done));
}

void WebSocket::drop() { stream_->drop(); }

tcp::socket::executor_type WebSocket::executor() const { return stream_->executor(); }

bool WebSocket::is_too_long(const Error& error) { return error == websocket::error::message_too_big; }

}  // namespace docent::telepresence
