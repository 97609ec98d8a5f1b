#include "docent/telepresence/web_socket/web_socket.h"

#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>

namespace docent::telepresence {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using asio::ip::tcp;

struct WebSocket::Stream {
  explicit Stream(tcp::socket socket) : websocket{std::move(socket)} {}

  websocket::stream<beast::tcp_stream> websocket;
  beast::flat_buffer buffer;
  HttpRequest request;  ///< until it is accepted
};

WebSocket::WebSocket(tcp::socket socket, const WebSocketManner& manner)
    : stream_{std::make_shared<Stream>(std::move(socket))} {
  auto& stream = stream_->websocket;
  websocket::stream_base::timeout timeout{};
  timeout.handshake_timeout = manner.handshake_timeout;
  timeout.idle_timeout = manner.idle_timeout;
  timeout.keep_alive_pings = manner.pings;
  stream.set_option(timeout);
  websocket::permessage_deflate deflate;
  deflate.server_enable = deflate.client_enable = manner.compresses;
  stream.set_option(deflate);
  stream.read_message_max(manner.longest_message);
  stream.auto_fragment(false);
  if (manner.protocol.empty()) return;
  stream.set_option(websocket::stream_base::decorator([protocol = manner.protocol](websocket::response_type& response) {
    response.set(http::field::sec_websocket_protocol, protocol);
  }));
}

void WebSocket::accept(HttpRequest request, Done done) {
  stream_->request = std::move(request);
  stream_->websocket.async_accept(stream_->request, [stream = stream_, done = std::move(done)](Error error) {
    stream->request = {};
    done(error);
  });
}

void WebSocket::greet(const std::string& host, const std::string& target, Done done) {
  stream_->websocket.async_handshake(host, target,
                                     [stream = stream_, done = std::move(done)](Error error) { done(error); });
}

void WebSocket::write(std::string_view message, bool is_text, Done done) {
  stream_->websocket.text(is_text);
  stream_->websocket.async_write(asio::buffer(message.data(), message.size()),
                                 [stream = stream_, done = std::move(done)](Error error, std::size_t) { done(error); });
}

void WebSocket::read(Heard heard) {
  stream_->websocket.async_read(stream_->buffer,
                                [stream = stream_, heard = std::move(heard)](Error error, std::size_t) {
                                  std::string message = beast::buffers_to_string(stream->buffer.data());
                                  stream->buffer.consume(stream->buffer.size());
                                  heard(error, std::move(message), !stream->websocket.got_binary());
                                });
}

void WebSocket::close(CloseCode code, const std::string& reason, Done done) {
  stream_->websocket.async_close(
      websocket::close_reason{static_cast<websocket::close_code>(code), {reason.data(), reason.size()}},
      [stream = stream_, done = std::move(done)](Error error) { done(error); });
}

void WebSocket::drop() { beast::get_lowest_layer(stream_->websocket).close(); }

tcp::socket::executor_type WebSocket::executor() const { return stream_->websocket.get_executor(); }

bool WebSocket::is_too_long(const Error& error) { return error == websocket::error::message_too_big; }

}  // namespace docent::telepresence
