#include "docent/telepresence/server/uplink_session.h"

#include <algorithm>
#include <boost/asio/post.hpp>
#include <chrono>

#include "docent/telepresence/live_encoding.h"
#include "docent/telepresence/uplink/uplink_door.h"

namespace docent::telepresence {
namespace {

constexpr double kAtOnce = 2.0;  // [s] worth of what the line may say
constexpr const char* kTooFast = R"({"reason":"too_fast","about":""})";
constexpr std::size_t kLongestAddress = 64;
constexpr auto kTick = std::chrono::milliseconds{100};
constexpr std::size_t kMostAnswers = 2000;  // that wait; an uplink that lets more pile up is cut off
constexpr const char* kRobotPath = "/camera/robot.jpg";
constexpr const char* kScenePath = "/camera/scene.jpg";

/// As it is claimed, and no address of this side.
std::string far_address(const std::string& claimed) { return "far " + claimed.substr(0, kLongestAddress); }

}  // namespace

UplinkSession::UplinkSession(SessionOwner& sessions, UplinkOwner& owner, const WebServerParams& params,
                             std::unique_ptr<WebSocket> line, std::uint64_t number)
    : sessions_{sessions},
      owner_{owner},
      number_{number},
      picture_s_{params.uplink_picture_s},
      piece_bytes_{static_cast<std::size_t>(std::max(1, params.uplink_picture_bytes_per_s / 10))},
      line_{std::move(line)},
      timer_{line_->executor()},
      messages_{params.uplink_messages_per_second, kAtOnce * params.uplink_messages_per_second},
      calls_{params.uplink_calls_per_second, kAtOnce * params.uplink_calls_per_second},
      writes_{params.uplink_writes_per_second, kAtOnce * params.uplink_writes_per_second} {
  ++sessions_.connections;
}

WebSocketManner UplinkSession::manner() {
  return {.longest_message = kLongestToMuseum, .idle_timeout = kSilentLine, .compresses = true};
}

void UplinkSession::run(std::uint32_t slots) {
  stale_ = slots & wanted();
  line_->accept([self = shared_from_this()](WebSocket::Error error) {
    self->is_open_ = true;
    if (error) return self->leave();
    self->flush();
    self->feed_pictures();
    self->read();
  });
}

std::uint32_t UplinkSession::wanted() const {
  return ~(sessions_.full_slots | sessions_.detail_slots | sessions_.operator_slots | sessions_.stop_slots);
}

void UplinkSession::mark(std::size_t slot) {
  const std::uint32_t bit = 1U << slot;
  if ((wanted() & bit) == 0) return;
  stale_ |= bit;
  flush();
}

void UplinkSession::say(const FromMuseum& message) {
  if (answers_.size() >= kMostAnswers) return drop();
  answers_.push_back(encode(message));
  flush();
}

void UplinkSession::flush() {
  if (!is_open_ || is_writing_) return;
  if (!answers_.empty()) {
    sending_ = std::move(answers_.front());
    answers_.pop_front();
  } else {
    SharedText text;
    while (stale_ != 0 && !text) {
      do last_slot_ = (last_slot_ + 1) % 32;
      while ((stale_ & (1U << last_slot_)) == 0);
      stale_ &= ~(1U << last_slot_);
      text = sessions_.latest(last_slot_);
    }
    if (!text) return;
    sending_ = encode(UplinkSlot{last_slot_, *text});
  }
  is_writing_ = true;
  line_->write(sending_, false, [self = shared_from_this()](WebSocket::Error error) {
    self->is_writing_ = false;
    if (error) return self->leave();
    ++self->sessions_.messages_out;
    self->flush();
  });
}

void UplinkSession::feed_pictures() {
  if (!is_open_) return;
  const int period = std::max(1, static_cast<int>(picture_s_ * 10.0));
  if (ticks_++ % period == 0) {
    for (const auto& [path, cutter, taken] :
         {std::tuple{kRobotPath, &robot_, &robot_taken_}, std::tuple{kScenePath, &scene_, &scene_taken_}}) {
      const SiteReply reply = owner_.site->get(path);
      if (reply.status != 200 || reply.taken == *taken) continue;
      *taken = reply.taken;
      cutter->begin(path, reply.taken, reply.body);
    }
  }
  // One piece at a time, and none while something is still on its way: a pose never waits behind a picture.
  if (!is_writing_) {
    auto piece = robot_.next(piece_bytes_);
    if (!piece) piece = scene_.next(piece_bytes_);
    if (piece) say(*piece);
  }
  timer_.expires_after(kTick);
  timer_.async_wait([self = shared_from_this()](WebSocket::Error error) {
    if (!error) self->feed_pictures();
  });
}

void UplinkSession::read() {
  line_->read([self = shared_from_this()](WebSocket::Error error, const std::string& frame, bool /*is_text*/) {
    if (error) return self->leave();
    ++self->sessions_.messages_in;
    auto message = decode_to_museum(frame);
    if (message) {
      self->hear(std::move(*message));
    } else {
      ++self->sessions_.messages_refused;
    }
    self->read();
  });
}

void UplinkSession::hear(ToMuseum message) {
  if (const auto* arrival = std::get_if<UplinkArrival>(&message)) {
    const bool is_counted = owner_.arrived && messages_.take(TokenBucket::Clock::now());
    if (is_counted) owner_.arrived(far_address(arrival->address));
  } else if (const auto* said = std::get_if<UplinkMessage>(&message)) {
    hear(*said);
  } else {
    hear(std::move(std::get<UplinkCall>(message)));
  }
}

void UplinkSession::hear(const UplinkMessage& said) {
  // The far gateway has looked at it; here it is looked at again.
  const auto parsed = parse_client_message(said.text);
  const bool is_theirs = said.viewer < (1ULL << kUplinkShift);
  if (!parsed || !is_theirs || !may_ask(Role::visitor, *parsed, false)) return void(++sessions_.messages_refused);
  if (!messages_.take(TokenBucket::Clock::now())) {
    ++sessions_.messages_refused;
    return answer(said.viewer, encode_error(ReasonWord::too_fast));
  }
  sessions_.message({(number_ << kUplinkShift) | said.viewer, Role::visitor, "", "", "uplink"}, *parsed);
}

void UplinkSession::hear(UplinkCall call) {
  // From where a caller comes is what the other end says: it decides who shares with whom, and not how much all may.
  const auto now = TokenBucket::Clock::now();
  const bool is_within = calls_.take(now) && (call.request.method == "GET" || writes_.take(now));
  if (!is_within) return say(UplinkReply{call.call, {429, kTooFast, ""}});
  call.request.address = far_address(call.request.address);
  if (!call.request.target.starts_with("/api/v1")) {  // what does not change: the museum, its map and pictures
    const SiteReply document = owner_.site->get(call.request.target);
    return say(UplinkReply{call.call, {document.status, document.body ? *document.body : std::string{}, ""}});
  }
  if (!owner_.desk || *owner_.is_closing) return say(UplinkReply{call.call, {503, "{}", ""}});
  call.request.is_far = true;
  ++*owner_.asked;
  owner_.desk->take(std::move(call.request), [self = shared_from_this(), number = call.call](ApiReply reply) mutable {
    std::atomic<int>& asked = *self->owner_.asked;
    const auto executor = self->line_->executor();
    boost::asio::post(executor, [self = std::move(self), number, reply = std::move(reply)]() mutable {
      self->say(UplinkReply{number, std::move(reply)});
    });
    --asked;  // last: then the server may go
  });
}

void UplinkSession::leave() {
  if (!std::exchange(is_open_, false)) return;
  timer_.cancel();
  owner_.left(number_);
}

}  // namespace docent::telepresence
