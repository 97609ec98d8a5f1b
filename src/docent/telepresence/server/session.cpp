#include "docent/telepresence/server/session.h"

#include <chrono>
#include <utility>

#include "docent/telepresence/limits/network.h"
#include "docent/telepresence/live_encoding.h"

namespace docent::telepresence {

namespace {

WebSocketManner manner_of(const WebServerParams& params) {
  return {.longest_message = static_cast<std::size_t>(params.max_message_bytes),
          .handshake_timeout = std::chrono::seconds{10},
          .idle_timeout = std::chrono::milliseconds{static_cast<int>(params.idle_timeout_s * 1e3)}};
}

}  // namespace

Session::Session(SessionOwner& owner, const WebServerParams& params, boost::asio::ip::tcp::socket socket, Caller caller,
                 bool must_be_thin, std::shared_ptr<Place> place)
    : owner_{owner},
      caller_{std::move(caller)},
      network_{network_of(caller_.address)},
      place_{std::move(place)},
      bucket_{caller_.role == Role::staff ? params.steering_per_second : params.messages_per_second,
              caller_.role == Role::staff ? 2.0 * params.steering_per_second : params.message_burst},
      socket_{std::move(socket), manner_of(params)},
      must_be_thin_{must_be_thin},
      is_thin_{must_be_thin} {
  ++owner_.connections;
}

void Session::run(HttpRequest request, std::uint32_t slots, bool is_thin) {
  is_thin_ = is_thin || must_be_thin_;
  queue_ = ViewerQueue{slots & wanted()};
  socket_.accept(std::move(request), [self = shared_from_this()](WebSocket::Error error) {
    if (error) return self->leave();
    self->is_open_ = true;
    self->flush();
    self->read();
  });
}

std::uint32_t Session::wanted() const {
  // An operator's connection is for orders and what becomes of them; they watch on another.
  if (caller_.role == Role::staff) return owner_.operator_slots | owner_.stop_slots;
  const bool may_stop = caller_.role == Role::kiosk && owner_.screen_stops;
  const std::uint32_t others = owner_.operator_slots | (may_stop ? 0 : owner_.stop_slots) |
                               (is_thin_ ? owner_.full_slots : owner_.thin_slots) |
                               (wants_details_ ? 0 : owner_.detail_slots);
  return ~others;
}

void Session::watch(const WatchMessage& wish) {
  const std::uint32_t before = wanted();
  wants_details_ = wish.details;
  is_thin_ = wish.thin || must_be_thin_;
  queue_.mark(wanted() & ~before);
  flush();
}

void Session::mark(std::size_t slot) {
  const std::uint32_t bit = 1U << slot;
  if ((wanted() & bit) == 0) return;
  if (queue_.mark(bit)) ++owner_.values_skipped;
}

void Session::answer(SharedText text) {
  if (!queue_.answer(std::move(text))) return close(CloseCode::policy_error, "too many unread answers");
  flush();
}

void Session::flush() {
  if (!is_open_ || is_writing_ || is_closing_) return;
  sending_ = queue_.next(owner_.latest);
  if (!sending_) return;
  is_writing_ = true;
  socket_.write(*sending_, true, [self = shared_from_this()](WebSocket::Error error) {
    self->is_writing_ = false;
    if (error) return self->leave();
    ++self->owner_.messages_out;
    self->flush();
  });
}

void Session::read() {
  socket_.read([self = shared_from_this()](WebSocket::Error error, const std::string& text, bool is_text) {
    if (error) {
      if (WebSocket::is_too_long(error)) ++self->owner_.messages_refused;
      return self->leave();
    }
    self->take(text, is_text);
  });
}

bool Session::is_within_rate() {
  const auto now = TokenBucket::Clock::now();
  if (!bucket_.take(now)) return false;
  const bool shares = caller_.role == Role::visitor;  // of the hall's screen and of operators there are few
  return !shares || owner_.of_address.take(network_, Time{std::chrono::nanoseconds{now.time_since_epoch()}.count()});
}

void Session::take(const std::string& text, bool is_text) {
  if (is_closing_) return;
  ++owner_.messages_in;
  if (!is_text) return refuse(CloseCode::unknown_data, "text messages only");
  if (!is_within_rate()) {
    ++owner_.messages_refused;
    if (++too_many_ > 100) return close(CloseCode::policy_error, "too many messages");
    answer(std::make_shared<const std::string>(encode_error(ReasonWord::too_fast)));
    return read();
  }
  auto message = parse_client_message(text);
  if (!message) return refuse(CloseCode::policy_error, message.error().message);
  if (!may_ask(caller_.role, *message, owner_.screen_stops))
    return refuse(CloseCode::policy_error, "this is not yours to ask");
  if (const auto* wish = std::get_if<WatchMessage>(&*message)) {
    watch(*wish);
  } else {
    owner_.message(caller_, *message);
  }
  read();
}

void Session::refuse(CloseCode code, const std::string& reason) {
  ++owner_.messages_refused;
  close(code, reason);
}

void Session::close(CloseCode code, const std::string& reason) {
  if (is_closing_) return;
  is_closing_ = true;
  socket_.close(code, reason.substr(0, 120), [self = shared_from_this()](WebSocket::Error) { self->leave(); });
}

void Session::end(const std::string& why) {
  const auto self = shared_from_this();
  close(CloseCode::policy_error, why);
  owner_.left(caller_);
}

void Session::leave() {
  is_open_ = false;
  owner_.left(caller_);
}

}  // namespace docent::telepresence
