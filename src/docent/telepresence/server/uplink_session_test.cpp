#include "docent/telepresence/server/uplink_session.h"

#include <gtest/gtest.h>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <thread>

#include "docent/telepresence/server/web_server.h"
#include "docent/telepresence/uplink/uplink_client.h"

namespace docent::telepresence {
namespace {

using namespace std::chrono_literals;

constexpr const char* kKey = "0123456789abcdef0123456789abcdef";

int a_free_port() {
  boost::asio::io_context io;
  boost::asio::ip::tcp::acceptor one{io, {boost::asio::ip::address_v4::loopback(), 0}};
  return one.local_endpoint().port();
}

/// Answers everything at once.
class QuickDesk final : public ApiDesk {
 public:
  void take(ApiRequest request, std::function<void(ApiReply)> answer) override {
    {
      const std::scoped_lock lock{mutex};
      requests.push_back(std::move(request));
    }
    answer({200, "{}", ""});
  }
  void admit(std::string /*token*/, std::function<void(Admitted)> answer) override {
    answer(std::optional<Admission>{});
  }
  std::mutex mutex;
  std::vector<ApiRequest> requests;
};

/// A museum's end, and a far gateway that says what it likes.
class UplinkSessionTest : public testing::Test {
 protected:
  void SetUp() override {
    WebServerParams params;
    params.port = 0;
    params.uplink_port = a_free_port();
    params.uplink_messages_per_second = 20.0;
    params.uplink_calls_per_second = 20.0;
    params.uplink_writes_per_second = 5.0;
    WebServerHooks hooks;
    hooks.message = [this](const Caller& caller, const ClientMessage&) {
      const std::scoped_lock lock{mutex_};
      callers_.push_back(caller);
    };
    hooks.uplink_key = kKey;
    hooks.desk = desk_;
    auto server = WebServer::start(params, std::make_shared<Site>(), std::move(hooks));
    ASSERT_TRUE(server) << server.error().message;
    server_ = std::move(*server);
    UplinkHooks far;
    far.slot = [](std::size_t, std::string) {};
    far.picture = [](JoinedPicture) {};
    far.answer = [this](std::uint64_t, const std::string& text) {
      const std::scoped_lock lock{mutex_};
      answers_.push_back(text);
    };
    far.line = [this](bool is_open) { is_open_ = is_open; };
    far_ = std::make_unique<UplinkClient>("127.0.0.1", std::to_string(params.uplink_port), kKey, std::move(far));
    ASSERT_TRUE(eventually([&] { return is_open_.load(); })) << far_->fault();
  }
  static bool eventually(const std::function<bool()>& done) {
    for (int i = 0; i < 1000; ++i) {
      if (done()) return true;
      std::this_thread::sleep_for(10ms);
    }
    return false;
  }
  std::size_t heard() {
    const std::scoped_lock lock{mutex_};
    return callers_.size() + answers_.size();
  }
  /// The statuses of so many calls at once.
  std::map<int, int> call(const std::string& method, int count) {
    std::mutex mutex;
    std::map<int, int> statuses;
    std::atomic<int> done = 0;
    for (int i = 0; i < count; ++i) {
      ApiRequest request;
      request.method = method;
      request.target = "/api/v1/forum";
      request.address = "192.0.2." + std::to_string(i);
      far_->take(std::move(request), [&](const ApiReply& reply) {
        const std::scoped_lock lock{mutex};
        ++statuses[reply.status];
        ++done;
      });
    }
    EXPECT_TRUE(eventually([&] { return done == count; }));
    const std::scoped_lock lock{mutex};
    return statuses;
  }

  std::mutex mutex_;
  std::vector<Caller> callers_;
  std::vector<std::string> answers_;
  std::atomic<bool> is_open_ = false;
  std::shared_ptr<QuickDesk> desk_ = std::make_shared<QuickDesk>();
  std::unique_ptr<WebServer> server_;
  std::unique_ptr<UplinkClient> far_;
};

TEST_F(UplinkSessionTest, WhateverItSaysOfItsViewersTheLineHasAShare) {
  const std::string vote =
      R"({"type":"vote","id":"018f3a6c-5b2e-7c3d-9a4b-0123456789ab","voter":"018f3a6c-5b2e-7c3d-9a4b-0123456789ac","tour":"highlights"})";
  for (std::uint64_t viewer = 1; viewer <= 400; ++viewer) ASSERT_TRUE(far_->say(UplinkMessage{viewer, vote}));
  ASSERT_TRUE(eventually([&] { return heard() == 400; }));
  const std::scoped_lock lock{mutex_};
  EXPECT_GE(callers_.size(), 40U) << "two seconds worth at once";
  EXPECT_LE(callers_.size(), 140U);
  for (const Caller& caller : callers_) {
    EXPECT_EQ(caller.role, Role::visitor);
    EXPECT_EQ(caller.address, "uplink") << "all of them are one";
  }
  for (const std::string& answer : answers_) EXPECT_NE(answer.find("too_fast"), std::string::npos) << answer;
}

TEST_F(UplinkSessionTest, CallsHaveAShareAndWritesASmallerOne) {
  auto writes = call("POST", 100);
  EXPECT_GE(writes[200], 10);
  EXPECT_LE(writes[200], 30);
  EXPECT_EQ(writes[200] + writes[429], 100);
  std::this_thread::sleep_for(2s);
  auto reads = call("GET", 100);
  EXPECT_GE(reads[200], 40);
  EXPECT_LE(reads[200], 80);
}

TEST_F(UplinkSessionTest, AnAddressThatIsClaimedIsNobodysHere) {
  EXPECT_EQ(call("GET", 1), (std::map<int, int>{{200, 1}}));
  const std::scoped_lock lock{desk_->mutex};
  ASSERT_EQ(desk_->requests.size(), 1U);
  EXPECT_EQ(desk_->requests[0].address, "far 192.0.2.0");
  EXPECT_TRUE(desk_->requests[0].is_far);
}

}  // namespace
}  // namespace docent::telepresence
