#include "docent/telepresence/server/http_connection.h"

#include <boost/beast/websocket/rfc6455.hpp>
#include <chrono>

namespace docent::telepresence {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using asio::ip::tcp;

constexpr auto kHttpTimeout = std::chrono::seconds{15};

std::string_view view_of(beast::string_view text) { return {text.data(), text.size()}; }

std::string etag_of(const SiteReply& reply) { return '"' + reply.taken + '"'; }

}  // namespace

void HttpConnection::read() {
  parser_.emplace();
  parser_->header_limit(8192);
  parser_->body_limit(1024);
  stream_.expires_after(kHttpTimeout);
  http::async_read(stream_, buffer_, *parser_, [self = shared_from_this()](beast::error_code error, std::size_t) {
    if (!error) return self->serve();
    if (error == http::error::header_limit || error == http::error::body_limit) {
      self->send(refusal(413, "too large\n"), false, false);
    } else if (error != http::error::end_of_stream &&
               error.category() == http::make_error_code(http::error::bad_method).category()) {
      self->send(refusal(400, "not HTTP\n"), false, false);
    }
  });
}

void HttpConnection::serve() {
  ++owner_.requests;
  HttpRequest request = parser_->release();
  const Route route = owner_.route({view_of(request.method_string()),
                                    view_of(request.target()),
                                    beast::websocket::is_upgrade(request),
                                    {view_of(request[http::field::origin]), view_of(request[http::field::host]), {}},
                                    is_local(request)});
  if (const auto* live = std::get_if<OpenLive>(&route)) {
    stream_.expires_never();
    return owner_.open_live(stream_.release_socket(), std::move(request), *live);
  }
  if (std::holds_alternative<OpenFoxglove>(route)) {
    stream_.expires_never();
    return owner_.open_foxglove(stream_.release_socket(), std::move(request));
  }
  HttpAnswer answer = std::get<HttpAnswer>(route);
  if (!answer.reply.taken.empty() && view_of(request[http::field::if_none_match]) == etag_of(answer.reply)) {
    answer.reply.status = 304;
    answer.is_head = true;  // they have the body
  }
  send(answer, request.keep_alive() && !answer.is_last,
       !answer.is_last && accepts_gzip(view_of(request[http::field::accept_encoding])));
}

bool HttpConnection::is_local(const HttpRequest& request) const {
  beast::error_code error;
  const auto peer = stream_.socket().remote_endpoint(error);
  if (error || !peer.address().is_loopback()) return false;
  for (const char* header : {"Forwarded", "X-Forwarded-For", "X-Real-IP", "Via"})
    if (request.find(header) != request.end()) return false;
  return true;
}

void HttpConnection::send(const HttpAnswer& answer, bool keep_alive, bool takes_gzip) {
  const SiteReply& reply = answer.reply;
  const bool is_gzipped = takes_gzip && reply.gzipped != nullptr;
  body_ = is_gzipped ? reply.gzipped : reply.body;
  response_.emplace();
  response_->result(static_cast<unsigned>(reply.status));
  response_->version(11);
  response_->set(http::field::server, "docent");
  response_->set(http::field::content_type, reply.content_type);
  response_->set(http::field::cache_control, reply.is_immutable ? "public, max-age=31536000, immutable" : "no-cache");
  if (is_gzipped) response_->set(http::field::content_encoding, "gzip");
  if (!reply.taken.empty()) {
    response_->set(http::field::etag, etag_of(reply));
    response_->set("Docent-Taken", reply.taken);
  }
  if (reply.gzipped) response_->set(http::field::vary, "Accept-Encoding");
  response_->set("X-Content-Type-Options", "nosniff");
  response_->set("Referrer-Policy", "no-referrer");
  response_->set(
      "Content-Security-Policy",
      "default-src 'self'; connect-src 'self' ws: wss:; img-src 'self' data: blob:; media-src 'self' "
      "blob:; style-src 'self' 'unsafe-inline'; frame-ancestors 'self'; base-uri 'none'; form-action 'none'");
  response_->keep_alive(keep_alive);
  response_->content_length(body_->size());
  if (!answer.is_head) response_->body() = beast::span<const char>{body_->data(), body_->size()};
  stream_.expires_after(kHttpTimeout);
  serializer_.emplace(*response_);
  const auto done = [self = shared_from_this(), keep_alive](beast::error_code error, std::size_t) {
    if (error) return;
    if (keep_alive) return self->read();
    beast::error_code ignored;
    self->stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
  };
  if (answer.is_head) {
    http::async_write_header(stream_, *serializer_, done);
  } else {
    http::async_write(stream_, *serializer_, done);
  }
}

}  // namespace docent::telepresence
