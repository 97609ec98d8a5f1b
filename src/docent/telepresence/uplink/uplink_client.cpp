#include <utility>  // first: Beast 1.74 forgets it in C++20
//
#include <atomic>
#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <chrono>
#include <deque>
#include <future>
#include <map>
#include <mutex>
#include <thread>

#include "docent/telepresence/uplink/uplink_client.h"
#include "docent/telepresence/web_socket/web_socket.h"

namespace docent::telepresence {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
using asio::ip::tcp;

constexpr auto kPatience = std::chrono::seconds{10};
constexpr auto kPause = std::chrono::seconds{1};  // from a lost line to the next attempt
constexpr std::size_t kMostWaiting = 1000;        // messages
constexpr std::size_t kLargestFrame = 4U << 20U;  // bytes

ApiReply unanswered() { return {503, R"({"reason":"busy","about":"the line to the museum is down"})", ""}; }

ApiReply too_long() { return {413, R"({"reason":"not_understood","about":"too long"})", ""}; }

}  // namespace

class UplinkClient::Impl {
 public:
  Impl(std::string host, std::string port, std::string key, UplinkHooks hooks)
      : host_{std::move(host)}, port_{std::move(port)}, keys_{pre_shared(key)}, hooks_{std::move(hooks)} {
    asio::post(io_, [this] {
      connect();
      look();
    });
    thread_ = std::thread{[this] { io_.run(); }};
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
  ~Impl() {
    io_.stop();
    thread_.join();
    give_up_calls();
  }

  bool say(std::string frame) {
    if (!fits_museum(frame) || !is_open_ || waiting_count_ >= kMostWaiting) return false;
    ++waiting_count_;
    asio::post(io_, [this, frame = std::move(frame)]() mutable {
      waiting_.push_back(std::move(frame));
      flush();
    });
    return true;
  }
  void take(ApiRequest request, std::function<void(ApiReply)> answer) {
    if (!is_open_ || is_closed_) return answer(unanswered());
    asio::post(io_, [this, request = std::move(request), answer = std::move(answer)]() mutable {
      if (!socket_ || is_closed_ || calls_.size() >= kMostWaiting) return answer(unanswered());
      const std::uint64_t call = ++last_call_;
      std::string frame = encode(ToMuseum{UplinkCall{call, std::move(request)}});
      if (!fits_museum(frame)) return answer(too_long());
      calls_.emplace(call, Call{std::move(answer), Clock::now()});
      ++waiting_count_;
      waiting_.push_back(std::move(frame));
      flush();
    });
  }
  [[nodiscard]] std::string fault() const {
    const std::scoped_lock lock{fault_mutex_};
    return fault_;
  }
  void close() {
    is_closed_ = true;
    asio::post(io_, [this] { give_up_calls(); });
  }

 private:
  using Clock = std::chrono::steady_clock;
  struct Call {
    std::function<void(ApiReply)> answer;
    Clock::time_point since;
  };
  void connect() {
    auto resolved = std::make_shared<tcp::resolver>(io_);
    resolved->async_resolve(host_, port_,
                            [this, resolved](beast::error_code error, const tcp::resolver::results_type& at) {
                              if (error) return lose(error.message());
                              auto stream = std::make_shared<beast::tcp_stream>(io_);
                              stream->expires_after(kPatience);
                              stream->async_connect(at, [this, stream](beast::error_code failed, const tcp::endpoint&) {
                                if (failed) return lose(failed.message());
                                stream->expires_never();
                                greet(stream->release_socket());
                              });
                            });
  }
  void greet(tcp::socket socket) {
    socket_.emplace(
        std::move(socket),
        WebSocketManner{
            .longest_message = kLargestFrame, .idle_timeout = kPatience, .pings = false, .compresses = true},
        keys_);
    socket_->secure(false, [this](beast::error_code error) {
      if (error) return lose("the other end has another key, or is no uplink_port: " + error.message());
      socket_->greet(host_ + ":" + port_, "/uplink", [this](beast::error_code failed) {
        if (failed) return lose("sent away: another gateway holds the line (" + failed.message() + ")");
        is_open_ = true;
        tell_line(true);
        read();
      });
    });
  }
  void read() {
    socket_->read([this](beast::error_code error, const std::string& frame, bool /*is_text*/) {
      if (error) return lose(error.message());
      if (auto message = decode_from_museum(frame)) hear(std::move(*message));
      read();
    });
  }
  void hear(FromMuseum message) {
    if (auto* slot = std::get_if<UplinkSlot>(&message)) return hooks_.slot(slot->slot, std::move(slot->text));
    if (auto* answer = std::get_if<UplinkAnswer>(&message))
      return hooks_.answer(answer->viewer, std::move(answer->text));
    if (auto* piece = std::get_if<UplinkPiece>(&message)) {
      if (auto picture = joiner_.add(std::move(*piece))) hooks_.picture(std::move(*picture));
      return;
    }
    auto& reply = std::get<UplinkReply>(message);
    const auto call = calls_.find(reply.call);
    if (call == calls_.end()) return;
    const auto answer = std::move(call->second.answer);
    calls_.erase(call);
    answer(std::move(reply.reply));
  }
  void flush() {
    if (!is_open_ || is_writing_ || waiting_.empty()) return;
    is_writing_ = true;
    sending_ = std::move(waiting_.front());
    waiting_.pop_front();
    --waiting_count_;
    socket_->write(sending_, false, [this](beast::error_code error) {
      is_writing_ = false;
      if (error) return lose(error.message());
      flush();
    });
  }
  /// The line is down; tries again in a while. Reading and writing may both say so.
  void lose(const std::string& why) {
    if (is_lost_) return;
    is_lost_ = true;
    {
      const std::scoped_lock lock{fault_mutex_};
      fault_ = why;
    }
    if (is_open_.exchange(false)) tell_line(false);
    waiting_.clear();
    waiting_count_ = 0;
    give_up_calls();
    if (socket_) socket_->drop();
    timer_.expires_after(kPause);  // meanwhile what was under way ends, with an error
    timer_.async_wait([this](beast::error_code error) {
      if (error) return;
      is_lost_ = false;
      is_writing_ = false;
      connect();
    });
  }
  void tell_line(bool is_open) const {
    if (hooks_.line) hooks_.line(is_open);
  }
  void give_up_calls() {
    const auto calls = std::exchange(calls_, {});
    for (const auto& [call, waits] : calls) waits.answer(unanswered());
  }
  /// Every second: nobody waits for ever.
  void look() {
    for (auto call = calls_.begin(); call != calls_.end() && Clock::now() - call->second.since > kPatience;) {
      call->second.answer(unanswered());
      call = calls_.erase(call);
    }
    look_timer_.expires_after(std::chrono::seconds{1});
    look_timer_.async_wait([this](beast::error_code error) {
      if (!error) look();
    });
  }

  const std::string host_, port_;
  const std::shared_ptr<boost::asio::ssl::context> keys_;
  const UplinkHooks hooks_;
  asio::io_context io_{1};
  asio::steady_timer timer_{io_}, look_timer_{io_};
  std::atomic<bool> is_closed_{false};
  std::atomic<bool> is_open_{false};
  std::atomic<std::size_t> waiting_count_{0};
  // Only the client's thread touches these.
  std::optional<WebSocket> socket_;
  std::deque<std::string> waiting_;
  std::string sending_;
  std::map<std::uint64_t, Call> calls_;  ///< by their number, the oldest first
  std::uint64_t last_call_ = 0;
  PictureJoiner joiner_;
  bool is_writing_ = false;
  bool is_lost_ = false;
  mutable std::mutex fault_mutex_;
  std::string fault_ = "not opened yet";
  std::thread thread_;
};

UplinkClient::UplinkClient(std::string host, std::string port, std::string key, UplinkHooks hooks)
    : impl_{std::make_unique<Impl>(std::move(host), std::move(port), std::move(key), std::move(hooks))} {}
UplinkClient::~UplinkClient() = default;

bool UplinkClient::say(const ToMuseum& message) { return impl_->say(encode(message)); }

void UplinkClient::take(ApiRequest request, std::function<void(ApiReply)> answer) {
  impl_->take(std::move(request), std::move(answer));
}

std::string UplinkClient::fault() const { return impl_->fault(); }

Result<std::string> UplinkClient::fetch(const std::string& path) {
  ApiRequest request;
  request.method = "GET";
  request.target = path;
  std::promise<ApiReply> promise;
  take(std::move(request), [&promise](ApiReply reply) { promise.set_value(std::move(reply)); });
  ApiReply reply = promise.get_future().get();
  if (reply.status == 503) return fail(path + ": " + fault());
  if (reply.status != 200) return fail(path + ": " + std::to_string(reply.status));
  return std::move(reply.body);
}

void UplinkClient::close() { impl_->close(); }

void UplinkClient::admit(std::string /*token*/, std::function<void(Admitted)> answer) {
  answer(std::optional<Admission>{});  // who steers must be nearer than this
}

}  // namespace docent::telepresence
