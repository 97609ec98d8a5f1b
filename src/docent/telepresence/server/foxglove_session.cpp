#include "docent/telepresence/server/foxglove_session.h"

#include <optional>
#include <utility>

namespace docent::telepresence {

namespace {

constexpr std::size_t kLongestRequest = 65536;  // [bytes] a client names its subscriptions one by one
constexpr std::size_t kMostTexts = 64;          // answers that a client has not read; who has more is cut off

}  // namespace

FoxgloveSession::FoxgloveSession(FoxgloveHub& hub, boost::asio::ip::tcp::socket socket,
                                 std::function<void(FoxgloveSession*)> left)
    : hub_{hub},
      left_{std::move(left)},
      socket_{std::move(socket), {.longest_message = kLongestRequest, .protocols = protocols()}} {}

std::vector<std::string> FoxgloveSession::protocols() { return {kFoxgloveProtocols.begin(), kFoxgloveProtocols.end()}; }

FoxgloveSession::~FoxgloveSession() { hub_.leave(client_); }

void FoxgloveSession::run(HttpRequest request) {
  socket_.accept(std::move(request), [self = shared_from_this()](WebSocket::Error error) {
    if (error) return self->leave();
    self->is_open_ = true;
    self->say(self->hub_.server_info());
    self->say(self->hub_.advertisement());
    self->read();
  });
}

void FoxgloveSession::add(std::uint32_t channel, Time time, const FoxgloveClient::Bytes& message) {
  client_.add(channel, time, message);
  flush();
}

void FoxgloveSession::read() {
  socket_.read([self = shared_from_this()](WebSocket::Error error, const std::string& text, bool is_text) {
    if (error) return self->leave();
    self->take(text, is_text);
  });
}

void FoxgloveSession::take(const std::string& text, bool is_text) {
  // Binary is what it wants to publish.
  const auto request = is_text ? parse_foxglove_request(text) : FoxgloveRequest{FoxgloveOther{"publishing"}};
  std::string answer = request ? hub_.take(client_, *request) : encode_status(2, request.error().message);
  if (!answer.empty()) say(std::move(answer));
  if (texts_.size() > kMostTexts) return drop();
  read();
}

void FoxgloveSession::say(std::string text) {
  texts_.push_back(std::move(text));
  flush();
}

void FoxgloveSession::flush() {
  if (!is_open_ || is_writing_) return;
  const bool is_text = !texts_.empty();
  if (is_text) {
    sending_ = std::move(texts_.front());
    texts_.pop_front();
  } else if (auto message = client_.next()) {
    sending_ = std::move(*message);
  } else {
    return;
  }
  is_writing_ = true;
  socket_.write(sending_, is_text, [self = shared_from_this()](WebSocket::Error error) {
    self->is_writing_ = false;
    if (error) return self->leave();
    self->flush();
  });
}

void FoxgloveSession::leave() {
  is_open_ = false;
  if (left_) std::exchange(left_, nullptr)(this);
}

}  // namespace docent::telepresence
