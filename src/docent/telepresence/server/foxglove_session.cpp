#include "docent/telepresence/server/foxglove_session.h"

#include <chrono>
#include <optional>

namespace docent::telepresence {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;

namespace {

constexpr std::size_t kLongestRequest = 65536;  // [bytes] a client names its subscriptions one by one
constexpr std::size_t kMostTexts = 64;          // answers that a client has not read; who has more is cut off

}  // namespace

FoxgloveSession::FoxgloveSession(FoxgloveHub& hub, asio::ip::tcp::socket socket,
                                 std::function<void(FoxgloveSession*)> left)
    : hub_{hub}, left_{std::move(left)}, stream_{std::move(socket)} {
  auto timeout = websocket::stream_base::timeout::suggested(beast::role_type::server);
  timeout.keep_alive_pings = true;
  stream_.set_option(timeout);
  stream_.read_message_max(kLongestRequest);
  stream_.auto_fragment(false);
  stream_.set_option(websocket::stream_base::decorator([](websocket::response_type& response) {
    response.set(http::field::sec_websocket_protocol,
                 beast::string_view{kFoxgloveProtocol.data(), kFoxgloveProtocol.size()});
  }));
}

FoxgloveSession::~FoxgloveSession() { hub_.leave(client_); }

void FoxgloveSession::run(http::request<http::string_body> request) {
  request_ = std::move(request);
  stream_.async_accept(request_, [self = shared_from_this()](beast::error_code error) {
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
  stream_.async_read(buffer_, [self = shared_from_this()](beast::error_code error, std::size_t) {
    if (error) return self->leave();
    self->take();
  });
}

void FoxgloveSession::take() {
  const std::string text = beast::buffers_to_string(buffer_.data());
  buffer_.consume(buffer_.size());
  const bool is_text = !stream_.got_binary();  // binary is what it wants to publish
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
  stream_.text(is_text);
  stream_.async_write(asio::buffer(sending_), [self = shared_from_this()](beast::error_code error, std::size_t) {
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
