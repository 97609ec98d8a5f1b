#include <utility>  // first: Beast 1.74 forgets it in C++20
//
#include <array>
#include <atomic>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <deque>
#include <map>
#include <optional>
#include <thread>

#include "docent/telepresence/web_server.h"

namespace docent {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using asio::ip::tcp;
using Clock = std::chrono::steady_clock;
using Text = std::shared_ptr<const std::string>;

constexpr std::size_t kGroups = 10;
constexpr auto kGroupPeriod = std::chrono::milliseconds{10};
constexpr std::size_t kManyViewers = 100;  // from here on sends are spread over the groups
constexpr std::size_t kMaxAnswers = 64;    // unread answers of one viewer
constexpr auto kHttpTimeout = std::chrono::seconds{15};
constexpr auto kKnownTarget = "/live";

/// Lets `burst` messages through at once and `rate` a second in the long run.
class TokenBucket {
 public:
  TokenBucket(double rate, double burst) : rate_{rate}, burst_{burst}, tokens_{burst} {}
  bool take(Clock::time_point now) {
    if (last_) tokens_ = std::min(burst_, tokens_ + rate_ * std::chrono::duration<double>(now - *last_).count());
    last_ = now;
    if (tokens_ < 1.0) return false;
    tokens_ -= 1.0;
    return true;
  }

 private:
  double rate_, burst_, tokens_;
  std::optional<Clock::time_point> last_;
};

class Viewer;

}  // namespace

struct WebServer::Core {
  Core(const WebServerParams& given, std::shared_ptr<const Site> the_site, MessageHandler the_handler)
      : params{given},
        site{std::move(the_site)},
        handler{std::move(the_handler)},
        acceptor{io},
        timer{io},
        accept_timer{io} {}

  void accept();
  void tick();
  void flush_all();

  const WebServerParams params;
  const std::shared_ptr<const Site> site;
  const MessageHandler handler;
  std::atomic<std::size_t> connections{0}, viewers{0};
  std::atomic<std::uint64_t> viewers_ever{0}, http_requests{0}, messages_in{0}, messages_refused{0}, messages_out{0},
      values_skipped{0};
  asio::io_context io{1};  // after the counters: its last handlers still count down
  tcp::acceptor acceptor;
  asio::steady_timer timer;
  asio::steady_timer accept_timer;
  // Only the server's thread touches these.
  std::array<Text, kSlots> latest;
  std::uint32_t detail_slots = 0;
  std::array<std::map<ViewerId, std::shared_ptr<Viewer>>, kGroups> groups;
  ViewerId next_viewer = 1;
  std::size_t next_group = 0;
  bool is_ticking = false;
  std::thread thread;
};

namespace {

/// A browser tells whose page opens the channel; a page of somebody else must not speak for its reader.
bool is_origin_allowed(beast::string_view origin, beast::string_view host, const std::vector<std::string>& others) {
  if (origin.empty()) return true;  // not a browser
  for (const beast::string_view scheme : {"http://", "https://"}) {
    if (origin.starts_with(scheme)) {
      origin.remove_prefix(scheme.size());
      break;
    }
  }
  if (beast::iequals(origin, host)) return true;
  for (const auto& other : others) {
    if (beast::iequals(origin, other)) return true;
  }
  return false;
}

/// One WebSocket. Lives as long as an operation of its is under way.
class Viewer : public std::enable_shared_from_this<Viewer> {
 public:
  template <class TheCore>
  Viewer(TheCore& core, tcp::socket socket, ViewerId id)
      : id_{id},
        max_bytes_{static_cast<std::size_t>(core.params.max_message_bytes)},
        bucket_{core.params.messages_per_second, core.params.message_burst},
        stream_{std::move(socket)},
        hooks_{[&core](ViewerId viewer, const ClientMessage& message) { core.handler(viewer, message); },
               [&core](ViewerId viewer) {
                 if (core.groups[viewer % kGroups].erase(viewer) > 0) --core.viewers;
               },
               [&core](std::size_t slot) { return core.latest[slot]; }},
        counts_{&core.messages_in, &core.messages_refused, &core.messages_out, &core.values_skipped},
        detail_slots_{&core.detail_slots} {
    ++core.connections;
    connections_ = &core.connections;
    websocket::stream_base::timeout timeout{};
    timeout.handshake_timeout = std::chrono::seconds{10};
    timeout.idle_timeout = std::chrono::milliseconds{static_cast<int>(core.params.idle_timeout_s * 1e3)};
    timeout.keep_alive_pings = true;
    stream_.set_option(timeout);
    stream_.read_message_max(max_bytes_);
    stream_.auto_fragment(false);
  }
  ~Viewer() { --*connections_; }
  Viewer(const Viewer&) = delete;
  Viewer& operator=(const Viewer&) = delete;

  void run(http::request<http::string_body> request, std::uint32_t slots) {
    stale_ = slots;
    request_ = std::move(request);
    stream_.async_accept(request_, [self = shared_from_this()](beast::error_code error) {
      if (error) return self->leave();
      self->is_open_ = true;
      self->stream_.text(true);
      self->flush();
      self->read();
    });
  }
  void mark(std::size_t slot) {
    const std::uint32_t bit = 1U << slot;
    if ((*detail_slots_ & bit) != 0 && !wants_details_) return;
    if ((stale_ & bit) != 0) ++*counts_.skipped;
    stale_ |= bit;
  }
  void answer(Text text) {
    if (answers_.size() >= kMaxAnswers) return close(websocket::close_code::policy_error, "too many unread answers");
    answers_.push_back(std::move(text));
    flush();
  }
  /// Sends the next thing unless one is being sent.
  void flush() {
    if (!is_open_ || is_writing_ || is_closing_) return;
    if (!answers_.empty()) {
      sending_ = std::move(answers_.front());
      answers_.pop_front();
    } else {
      if (stale_ == 0) return;
      // Round robin, so that a fast slot does not starve the others.
      do next_slot_ = (next_slot_ + 1) % WebServer::kSlots;
      while ((stale_ & (1U << next_slot_)) == 0);
      stale_ &= ~(1U << next_slot_);
      sending_ = hooks_.latest(next_slot_);
      if (!sending_) return flush();
    }
    is_writing_ = true;
    stream_.async_write(asio::buffer(*sending_), [self = shared_from_this()](beast::error_code error, std::size_t) {
      self->is_writing_ = false;
      if (error) return self->leave();
      ++*self->counts_.out;
      self->flush();
    });
  }
  void drop() { beast::get_lowest_layer(stream_).close(); }

 private:
  struct Hooks {
    std::function<void(ViewerId, const ClientMessage&)> message;
    std::function<void(ViewerId)> left;
    std::function<Text(std::size_t)> latest;
  };
  struct Counts {
    std::atomic<std::uint64_t>*in, *refused, *out, *skipped;
  };

  void read() {
    stream_.async_read(buffer_, [self = shared_from_this()](beast::error_code error, std::size_t) {
      if (error) {
        if (error == websocket::error::message_too_big) ++*self->counts_.refused;
        return self->leave();
      }
      self->take();
    });
  }
  void take() {
    ++*counts_.in;
    const std::string text = beast::buffers_to_string(buffer_.data());
    buffer_.consume(buffer_.size());
    if (stream_.got_binary()) return refuse(websocket::close_code::unknown_data, "text messages only");
    if (!bucket_.take(Clock::now())) {
      ++*counts_.refused;
      if (++too_many_ > 100) return close(websocket::close_code::policy_error, "too many messages");
      answer(std::make_shared<const std::string>(R"({"type":"error","reason":"too many messages, wait a moment"})"));
      return read();
    }
    auto message = parse_client_message(text);
    if (!message) return refuse(websocket::close_code::policy_error, message.error().message);
    if (const auto* watch = std::get_if<WatchMessage>(&*message)) {
      if (watch->details && !wants_details_) stale_ |= *detail_slots_;
      wants_details_ = watch->details;
      flush();
    } else {
      hooks_.message(id_, *message);
    }
    read();
  }
  void refuse(websocket::close_code code, const std::string& reason) {
    ++*counts_.refused;
    close(code, reason);
  }
  void close(websocket::close_code code, const std::string& reason) {
    if (is_closing_) return;
    is_closing_ = true;
    stream_.async_close(websocket::close_reason{code, reason.substr(0, 120)},
                        [self = shared_from_this()](beast::error_code) { self->leave(); });
  }
  void leave() {
    is_open_ = false;
    hooks_.left(id_);
  }

  const ViewerId id_;
  const std::size_t max_bytes_;
  TokenBucket bucket_;
  websocket::stream<beast::tcp_stream> stream_;
  Hooks hooks_;
  Counts counts_;
  const std::uint32_t* detail_slots_;
  std::atomic<std::size_t>* connections_ = nullptr;
  http::request<http::string_body> request_;
  beast::flat_buffer buffer_;
  std::deque<Text> answers_;
  Text sending_;
  std::uint32_t stale_ = 0;
  std::size_t next_slot_ = 0;
  int too_many_ = 0;
  bool is_open_ = false;
  bool is_writing_ = false;
  bool is_closing_ = false;
  bool wants_details_ = false;
};

/// One HTTP connection, until it is closed or becomes a viewer.
template <class TheCore>
class HttpSessionOf : public std::enable_shared_from_this<HttpSessionOf<TheCore>> {
 public:
  HttpSessionOf(TheCore& core, tcp::socket socket) : core_{core}, stream_{std::move(socket)} { ++core_.connections; }
  ~HttpSessionOf() { --core_.connections; }
  HttpSessionOf(const HttpSessionOf&) = delete;
  HttpSessionOf& operator=(const HttpSessionOf&) = delete;

  void read() {
    parser_.emplace();
    parser_->header_limit(8192);
    parser_->body_limit(1024);
    stream_.expires_after(kHttpTimeout);
    http::async_read(stream_, buffer_, *parser_,
                     [self = this->shared_from_this()](beast::error_code error, std::size_t) {
                       if (!error) return self->serve();
                       if (error == http::error::header_limit || error == http::error::body_limit) {
                         self->reply_error(http::status::payload_too_large, "too large\n");
                       } else if (error != http::error::end_of_stream &&
                                  error.category() == http::make_error_code(http::error::bad_method).category()) {
                         self->reply_error(http::status::bad_request, "not HTTP\n");
                       }
                     });
  }

 private:
  using Body = http::span_body<const char>;

  void serve() {
    ++core_.http_requests;
    auto request = parser_->release();
    const beast::string_view target = request.target();
    if (websocket::is_upgrade(request)) {
      if (target != kKnownTarget) return reply_error(http::status::not_found, "not found\n");
      if (!is_origin_allowed(request[http::field::origin], request[http::field::host], core_.params.origins)) {
        return reply_error(http::status::forbidden, "pages of another site may not steer the robot\n");
      }
      if (core_.viewers >= static_cast<std::size_t>(core_.params.max_viewers)) {
        return reply_error(http::status::service_unavailable, "too many viewers\n");
      }
      return upgrade(std::move(request));
    }
    const bool is_head = request.method() == http::verb::head;
    if (!is_head && request.method() != http::verb::get) {
      return reply_error(http::status::method_not_allowed, "GET only\n");
    }
    const SiteReply reply = core_.site->get({target.data(), target.size()});
    const beast::string_view encodings = request[http::field::accept_encoding];
    send(reply, is_head, request.keep_alive(), accepts_gzip({encodings.data(), encodings.size()}));
  }

  void upgrade(http::request<http::string_body> request) {
    stream_.expires_never();
    tcp::socket socket = stream_.release_socket();
    beast::error_code ignored;
    socket.set_option(tcp::no_delay{true}, ignored);
    socket.set_option(asio::socket_base::send_buffer_size{core_.params.send_buffer_bytes}, ignored);
    const ViewerId id = core_.next_viewer++;
    const auto viewer = std::make_shared<Viewer>(core_, std::move(socket), id);
    core_.groups[id % kGroups].emplace(id, viewer);
    ++core_.viewers;
    ++core_.viewers_ever;
    std::uint32_t slots = 0;
    for (std::size_t slot = 0; slot < core_.latest.size(); ++slot) {
      if (core_.latest[slot]) slots |= 1U << slot;
    }
    viewer->run(std::move(request), slots & ~core_.detail_slots);
  }

  void reply_error(http::status status, std::string text) {
    SiteReply reply;
    reply.status = static_cast<int>(status);
    reply.body = std::make_shared<const std::string>(std::move(text));
    send(reply, false, false, false);
  }

  void send(const SiteReply& reply, bool is_head, bool keep_alive, bool takes_gzip) {
    const bool is_gzipped = takes_gzip && reply.gzipped != nullptr;
    body_ = is_gzipped ? reply.gzipped : reply.body;
    response_.emplace();
    response_->result(static_cast<unsigned>(reply.status));
    response_->version(11);
    response_->set(http::field::server, "docent");
    response_->set(http::field::content_type, reply.content_type);
    response_->set(http::field::cache_control, reply.is_immutable ? "public, max-age=31536000, immutable" : "no-cache");
    if (is_gzipped) response_->set(http::field::content_encoding, "gzip");
    if (reply.gzipped) response_->set(http::field::vary, "Accept-Encoding");
    response_->set("X-Content-Type-Options", "nosniff");
    response_->set("Referrer-Policy", "no-referrer");
    response_->set(
        "Content-Security-Policy",
        "default-src 'self'; connect-src 'self' ws: wss:; img-src 'self' data: blob:; media-src 'self' "
        "blob:; style-src 'self' 'unsafe-inline'; frame-ancestors 'self'; base-uri 'none'; form-action 'none'");
    response_->keep_alive(keep_alive);
    response_->content_length(body_->size());
    if (!is_head) response_->body() = beast::span<const char>{body_->data(), body_->size()};
    stream_.expires_after(kHttpTimeout);
    serializer_.emplace(*response_);
    const auto done = [self = this->shared_from_this(), keep_alive](beast::error_code error, std::size_t) {
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

  TheCore& core_;
  beast::tcp_stream stream_;
  beast::flat_buffer buffer_;
  std::optional<http::request_parser<http::string_body>> parser_;
  Text body_;
  std::optional<http::response<Body>> response_;
  std::optional<http::response_serializer<Body>> serializer_;
};

}  // namespace

Result<void> WebServerParams::validate() const {
  if (port < 0 || port > 65535) return fail("web.port must be 0 to 65535");
  if (max_connections < 1) return fail("web.max_connections must be at least 1");
  if (max_viewers < 1) return fail("web.max_viewers must be at least 1");
  if (!(messages_per_second > 0.0)) return fail("web.messages_per_second must be > 0");
  if (!(message_burst >= 1.0)) return fail("web.message_burst must be at least 1");
  if (max_message_bytes < 256 || max_message_bytes > 1 << 20)
    return fail("web.max_message_bytes must be 256 to 1048576");
  if (send_buffer_bytes < 4096) return fail("web.send_buffer_bytes must be at least 4096");
  if (!(idle_timeout_s >= 1.0)) return fail("web.idle_timeout_s must be at least 1");
  return {};
}

void WebServer::Core::accept() {
  acceptor.async_accept([this](beast::error_code error, tcp::socket socket) {
    if (error == asio::error::operation_aborted) return;
    if (error) {  // out of descriptors: wait for some to come free
      accept_timer.expires_after(std::chrono::milliseconds{100});
      accept_timer.async_wait([this](beast::error_code) { accept(); });
      return;
    }
    if (connections < static_cast<std::size_t>(params.max_connections)) {
      std::make_shared<HttpSessionOf<Core>>(*this, std::move(socket))->read();
    }
    accept();
  });
}

void WebServer::Core::tick() {
  for (auto& [id, viewer] : groups[next_group]) viewer->flush();
  next_group = (next_group + 1) % kGroups;
  is_ticking = viewers > kManyViewers;
  if (!is_ticking) return flush_all();
  timer.expires_after(kGroupPeriod);  // from now: a late tick is skipped, not caught up
  timer.async_wait([this](beast::error_code error) {
    if (!error) tick();
  });
}

void WebServer::Core::flush_all() {
  for (auto& group : groups) {
    for (auto& [id, viewer] : group) viewer->flush();
  }
}

WebServer::WebServer(std::unique_ptr<Core> core) : core_{std::move(core)} {}

Result<std::unique_ptr<WebServer>> WebServer::start(const WebServerParams& params, std::shared_ptr<const Site> site,
                                                    MessageHandler handler) {
  const std::string name = params.address + ":" + std::to_string(params.port);
  beast::error_code error;
  const auto address = asio::ip::make_address(params.address, error);
  if (error) return fail(name + ": not an address");
  auto core = std::make_unique<Core>(params, std::move(site), std::move(handler));
  const tcp::endpoint endpoint{address, static_cast<std::uint16_t>(params.port)};
  core->acceptor.open(endpoint.protocol(), error);
  if (!error) core->acceptor.set_option(asio::socket_base::reuse_address{true}, error);
  if (!error) core->acceptor.bind(endpoint, error);
  if (!error) core->acceptor.listen(asio::socket_base::max_listen_connections, error);
  if (error == asio::error::address_in_use) return fail(name + ": the port is in use by another program");
  if (error) return fail(name + ": cannot listen: " + error.message());
  core->accept();
  core->thread = std::thread{[raw = core.get()] { raw->io.run(); }};
  return std::unique_ptr<WebServer>{new WebServer{std::move(core)}};
}

WebServer::~WebServer() {
  core_->io.stop();
  core_->thread.join();
  for (auto& group : core_->groups) {
    for (auto& [id, viewer] : group) viewer->drop();
    group.clear();
  }
}

int WebServer::port() const { return core_->acceptor.local_endpoint().port(); }

void WebServer::broadcast(int slot, std::string text) {
  auto shared = std::make_shared<const std::string>(std::move(text));
  asio::post(core_->io, [core = core_.get(), slot = static_cast<std::size_t>(slot), shared = std::move(shared)] {
    core->latest[slot] = shared;
    for (auto& group : core->groups) {
      for (auto& [id, viewer] : group) viewer->mark(slot);
    }
    if (core->is_ticking) return;
    if (core->viewers > kManyViewers) return core->tick();
    core->flush_all();
  });
}

void WebServer::restrict_to_details(int slot) {
  asio::post(core_->io, [core = core_.get(), slot] { core->detail_slots |= 1U << static_cast<unsigned>(slot); });
}

void WebServer::send(ViewerId viewer, std::string text) {
  asio::post(core_->io, [core = core_.get(), viewer, shared = std::make_shared<const std::string>(std::move(text))] {
    auto& group = core->groups[viewer % kGroups];
    if (const auto place = group.find(viewer); place != group.end()) {
      const auto held = place->second;  // closing it may take it out of the group
      held->answer(shared);
    }
  });
}

WebServerFigures WebServer::figures() const {
  return {core_->connections, core_->viewers,          core_->viewers_ever, core_->http_requests,
          core_->messages_in, core_->messages_refused, core_->messages_out, core_->values_skipped};
}

}  // namespace docent
