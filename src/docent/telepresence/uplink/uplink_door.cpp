#include "docent/telepresence/uplink/uplink_door.h"

#include <chrono>

namespace docent::telepresence {
namespace {

using boost::asio::ip::tcp;
using ErrorCode = boost::system::error_code;

constexpr int kMostGreeted = 8;  // at once: one is due
constexpr auto kBreath = std::chrono::milliseconds{100};
constexpr auto kPauseOfGateways = std::chrono::seconds{4};  // between two attempts, and what they take
constexpr auto kToldFor = std::chrono::minutes{1};

}  // namespace

Result<void> UplinkDoor::listen(const tcp::endpoint& at, const std::string& key) {
  keys_ = pre_shared(key);
  const std::string name = at.address().to_string() + ":" + std::to_string(at.port());
  ErrorCode error;
  acceptor_.open(at.protocol(), error);
  if (!error) acceptor_.set_option(boost::asio::socket_base::reuse_address{true}, error);
  if (!error) acceptor_.bind(at, error);
  if (!error) acceptor_.listen(kMostGreeted, error);
  if (error == boost::asio::error::address_in_use) return fail(name + ": the port is in use by another program");
  if (error) return fail(name + ": cannot listen: " + error.message());
  accept();
  return {};
}

void UplinkDoor::accept() {
  acceptor_.async_accept([this](ErrorCode error, tcp::socket socket) {
    if (error == boost::asio::error::operation_aborted) return;
    if (!error && *greeted_ < kMostGreeted) greet(std::move(socket));
    if (!error) return accept();
    pause_.expires_after(kBreath);  // out of descriptors: wait for some to come free
    pause_.async_wait([this](ErrorCode) { accept(); });
  });
}

void UplinkDoor::greet(tcp::socket socket) {
  constexpr int kLittle = 8192;  // what the kernel holds is old before it has left
  ErrorCode error;
  const auto peer = socket.remote_endpoint(error);
  if (error) return;
  socket.set_option(tcp::no_delay{true}, error);
  socket.set_option(boost::asio::socket_base::send_buffer_size{kLittle}, error);
  auto line =
      std::make_shared<std::unique_ptr<WebSocket>>(std::make_unique<WebSocket>(std::move(socket), manner_, keys_));
  WebSocket& end = **line;
  ++*greeted_;
  end.secure(true, [this, line, greeted = greeted_, address = peer.address().to_string()](ErrorCode failed) {
    --*greeted;
    if (!failed) opened_(std::move(*line), address);
  });
}

void SecondHolder::sent_away(const std::string& address, Clock::time_point now) {
  const std::scoped_lock lock{mutex_};
  last_ = now;
  if (!since_) since_ = last_;
  address_ = address;
}

void SecondHolder::came_in() {
  const std::scoped_lock lock{mutex_};
  since_.reset();
}

std::string SecondHolder::address(Clock::time_point now) const {
  const std::scoped_lock lock{mutex_};
  const bool is_another = since_ && last_ - *since_ > kSilentLine + kPauseOfGateways;
  return is_another && now - last_ < kToldFor ? address_ : std::string{};
}

}  // namespace docent::telepresence
