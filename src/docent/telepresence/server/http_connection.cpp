#include "docent/telepresence/server/http_connection.h"

#include <algorithm>
#include <boost/asio/post.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <chrono>

#include "docent/telepresence/server/foxglove_session.h"

namespace docent::telepresence {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using asio::ip::tcp;

constexpr auto kHttpTimeout = std::chrono::seconds{15};
constexpr std::size_t kLongestSecret = 128;  // bytes: one of ours is shorter
constexpr int kMostLargeBodies = 4;          // read at a time, so that nobody fills the memory with them

std::string_view view_of(beast::string_view text) { return {text.data(), text.size()}; }

/// Of a header that comes in several lines, the last: some proxies add a line where others add to a list.
std::string_view last_of(const http::request<http::string_body>& request, const char* name) {
  const auto [first, end] = request.equal_range(name);
  std::string_view last;
  for (auto line = first; line != end; ++line) last = view_of(line->value());
  return last;
}

/// Whoever has logged in may be one of ours; nobody knows it now.
HttpAnswer unrecognized(const Error& why) {
  return refusal(503, "Nobody can be recognized now: " + why.message + ".\n");
}

std::string etag_of(const SiteReply& reply) { return '"' + reply.taken + '"'; }

}  // namespace

template <class Answer, class Then>
auto HttpConnection::when_answered(Then then) {
  ++owner_.asked;
  return [self = shared_from_this(), then = std::move(then)](Answer answer) mutable {
    HttpOwner& owner = self->owner_;
    const auto executor = self->stream_.get_executor();
    asio::post(executor, [self = std::move(self), then = std::move(then), answer = std::move(answer)]() mutable {
      then(*self, std::move(answer));
    });
    --owner.asked;  // last: then the server may go
  };
}

void HttpConnection::read() {
  parser_.emplace();
  parser_->header_limit(8192);
  parser_->body_limit(kLongestMuseum);
  stream_.expires_after(kHttpTimeout);
  http::async_read_header(stream_, buffer_, *parser_,
                          [self = shared_from_this()](beast::error_code error, std::size_t) {
                            if (error) return self->complain(error);
                            self->look_at_header();
                          });
}

/// What can be said before the body has come.
void HttpConnection::look_at_header() {
  const auto& request = parser_->get();
  if (!is_called_rightly(request)) {
    return send(refusal(421,
                        "This robot is not known by that name. Its name belongs into web.hosts of robot.yaml, or the "
                        "address of the proxy that calls it so into web.proxies.\n"),
                false, false);
  }
  if (request.target().size() > kLongestTarget) return send(refusal(414, "too long\n"), false, false);
  if (!understand_call()) return send_to_page(false);
  const std::uint64_t length = parser_->content_length().value_or(0);
  if (length > longest_body_of(view_of(request.target()))) return send(refusal(413, "too large\n"), false, false);
  if (length > kLongestBody) return read_large_body();
  parser_->body_limit(kLongestBody);
  read_body();
}

bool HttpConnection::understand_call() {
  auto& request = parser_->get();
  const bool is_believed = is_proxy(peer_);
  ForwardedHeaders said;
  if (is_believed)
    said = {last_of(request, "X-Forwarded-For"), last_of(request, "X-Forwarded-Host"),
            last_of(request, "X-Forwarded-Proto"), last_of(request, "X-Forwarded-Prefix")};
  called_ = as_called(said, is_believed, peer_, view_of(request[http::field::host]));
  const auto below = below_prefix(view_of(request.target()), owner_.prefix);
  if (!below) return true;
  if (below->empty()) return false;
  // A proxy that takes no path away may name it nevertheless.
  if (!called_.prefix.ends_with(owner_.prefix)) called_.prefix += owner_.prefix;
  request.target(std::string{*below});
  return true;
}

/// Only operators hold one of the few places for large bodies.
void HttpConnection::read_large_body() {
  if (!owner_.desk || owner_.is_closing) return send(refusal(503, "not now\n"), false, false);
  std::string token{cookie_value(view_of(parser_->get()[http::field::cookie]), kLoginCookie)};
  auto begin = [](HttpConnection& self, const Admitted& who) {
    if (!who) return self.send(unrecognized(who.error()), false, false);
    if (!*who) return self.send(refusal(403, "for operators who have logged in\n"), false, false);
    if (self.owner_.large_bodies >= kMostLargeBodies) return self.send(refusal(503, "not now\n"), false, false);
    self.large_body_.emplace(self.owner_.large_bodies);
    self.read_body();
  };
  owner_.desk->admit(std::move(token), when_answered<Admitted>(std::move(begin)));
}

void HttpConnection::read_body() {
  if (parser_->is_done()) return serve();  // most requests have none
  http::async_read(stream_, buffer_, *parser_, [self = shared_from_this()](beast::error_code error, std::size_t) {
    if (error) return self->complain(error);
    self->serve();
    self->large_body_.reset();
  });
}

void HttpConnection::complain(beast::error_code error) {
  large_body_.reset();
  if (error == http::error::header_limit || error == http::error::body_limit) {
    send(refusal(413, "too large\n"), false, false);
  } else if (error != http::error::end_of_stream &&
             error.category() == http::make_error_code(http::error::bad_method).category()) {
    send(refusal(400, "not HTTP\n"), false, false);
  }
}

bool HttpConnection::is_proxy(const std::string& address) const {
  return std::find(owner_.proxies.begin(), owner_.proxies.end(), address) != owner_.proxies.end();
}

bool HttpConnection::is_called_rightly(const HttpRequest& request) const {
  return owner_.hosts.is_ours(view_of(request[http::field::host])) || is_proxy(peer_);
}

Opening HttpConnection::opening_of(const HttpRequest& request) const {
  return {view_of(request[http::field::origin]), called_.host, {}, called_.is_https};
}

void HttpConnection::call_api(const HttpRequest& request) {
  const bool keep_alive = request.keep_alive();
  if (!owner_.desk || owner_.is_closing) return send(refusal(503, "not now\n"), false, false);
  ApiRequest call;
  call.method = view_of(request.method_string());
  call.target = view_of(request.target());
  call.body = request.body();
  call.token = cookie_value(view_of(request[http::field::cookie]), kLoginCookie).substr(0, kLongestSecret);
  call.csrf = view_of(request["Docent-Csrf"]).substr(0, kLongestSecret);
  call.address = called_.address;
  call.is_json = view_of(request[http::field::content_type]).starts_with("application/json");
  call.is_of_ours = role_of(opening_of(request), owner_.origins, "").has_value();
  stream_.expires_never();  // until it is answered
  owner_.desk->take(std::move(call), when_answered<ApiReply>([keep_alive](HttpConnection& self, ApiReply reply) {
                      self.send(std::move(reply), keep_alive);
                    }));
}

void HttpConnection::admit(HttpRequest request) {
  if (!owner_.desk || owner_.is_closing) return send(refusal(503, "not now\n"), false, false);
  std::string token{cookie_value(view_of(request[http::field::cookie]), kLoginCookie)};
  stream_.expires_never();
  auto open = [request = std::move(request)](HttpConnection& self, Admitted who) mutable {
    if (!who) return self.send(unrecognized(who.error()), false, false);
    if (!*who) return self.send(refusal(403, "for operators who have logged in\n"), false, false);
    self.owner_.open_live(
        self.stream_.release_socket(), std::move(request),
        {Role::staff, false, self.called_.address, (*who)->name, (*who)->login, std::move(self.place_)});
  };
  owner_.desk->admit(std::move(token), when_answered<Admitted>(std::move(open)));
}

void HttpConnection::serve() {
  ++owner_.requests;
  HttpRequest request = parser_->release();
  const Route route =
      owner_.route({view_of(request.method_string()), view_of(request.target()), beast::websocket::is_upgrade(request),
                    opening_of(request), is_local(request) || (owner_.shows_foxglove_to_proxies && is_proxy(peer_))});
  if (const auto* live = std::get_if<OpenLive>(&route)) {
    stream_.expires_never();
    const std::string address = called_.address;
    const bool is_forwarded = !place_ && address != peer_;
    if (is_forwarded && live->role == Role::visitor && !(place_ = owner_.take_place(address)))
      return send(refusal(429, "too many connections from there\n"), false, false);
    return owner_.open_live(stream_.release_socket(), std::move(request),
                            {live->role, live->is_thin, address, "", "", std::move(place_)});
  }
  if (std::holds_alternative<CallApi>(route)) return call_api(request);
  if (std::holds_alternative<OpenOperate>(route)) return admit(std::move(request));
  if (std::holds_alternative<OpenFoxglove>(route)) {
    if (!agreed_protocol(request, FoxgloveSession::protocols()))
      return send(refusal(400, "none of these sub-protocols: foxglove.sdk.v1, foxglove.websocket.v1\n"), false, false);
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
  if (!is_peer_here_) return false;
  for (const char* header : {"Forwarded", "X-Forwarded-For", "X-Forwarded-Host", "X-Forwarded-Proto",
                             "X-Forwarded-Prefix", "X-Real-IP", "Via"})
    if (request.find(header) != request.end()) return false;
  return true;
}

void HttpConnection::set_common_headers() {
  response_->version(11);
  response_->set(http::field::server, "docent");
  response_->set("X-Content-Type-Options", "nosniff");
  response_->set("Referrer-Policy", "no-referrer");
  response_->set("Cross-Origin-Opener-Policy", "same-origin");
  response_->set("Permissions-Policy", "camera=(), geolocation=(), microphone=()");
  response_->set("Content-Security-Policy",
                 "default-src 'self'; connect-src 'self' ws: wss:; img-src 'self' data: blob:; media-src 'self' blob:; "
                 "style-src 'self' 'unsafe-inline'; object-src 'none'; frame-ancestors 'self'; base-uri 'none'; "
                 "form-action 'none'");
}

void HttpConnection::send(const HttpAnswer& answer, bool keep_alive, bool takes_gzip) {
  const SiteReply& reply = answer.reply;
  const bool is_gzipped = takes_gzip && reply.gzipped != nullptr;
  body_ = is_gzipped ? reply.gzipped : reply.body;
  response_.emplace();
  response_->result(static_cast<unsigned>(reply.status));
  set_common_headers();
  response_->set(http::field::content_type, reply.content_type);
  response_->set(http::field::cache_control, reply.is_immutable ? "public, max-age=31536000, immutable" : "no-cache");
  if (is_gzipped) response_->set(http::field::content_encoding, "gzip");
  if (!reply.taken.empty()) {
    response_->set(http::field::etag, etag_of(reply));
    response_->set("Docent-Taken", reply.taken);
  }
  if (reply.gzipped) response_->set(http::field::vary, "Accept-Encoding");
  write(answer.is_head, keep_alive);
}

void HttpConnection::send(ApiReply reply, bool keep_alive) {
  body_ = std::make_shared<const std::string>(std::move(reply.body));
  response_.emplace();
  response_->result(static_cast<unsigned>(reply.status));
  set_common_headers();
  response_->set(http::field::content_type, "application/json");
  response_->set(http::field::cache_control, "no-store");
  if (!reply.set_cookie.empty())
    response_->set(http::field::set_cookie, cookie_for(called_, std::move(reply.set_cookie)));
  write(false, keep_alive);
}

/// From "/robot" to "/robot/", whatever stands before it on the way: so its files are found.
void HttpConnection::send_to_page(bool keep_alive) {
  body_ = std::make_shared<const std::string>();
  response_.emplace();
  response_->result(http::status::permanent_redirect);
  set_common_headers();
  response_->set(http::field::location, owner_.prefix.substr(owner_.prefix.rfind('/') + 1) + "/");
  write(false, keep_alive);
}

void HttpConnection::write(bool is_head, bool keep_alive) {
  response_->keep_alive(keep_alive);
  response_->content_length(body_->size());
  if (!is_head) response_->body() = beast::span<const char>{body_->data(), body_->size()};
  stream_.expires_after(kHttpTimeout);
  serializer_.emplace(*response_);
  const auto done = [self = shared_from_this(), keep_alive](beast::error_code error, std::size_t) {
    if (error) return;
    if (keep_alive) return self->read();
    beast::error_code ignored;
    self->stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
  };
  if (is_head) {
    http::async_write_header(stream_, *serializer_, done);
  } else {
    http::async_write(stream_, *serializer_, done);
  }
}

}  // namespace docent::telepresence
