#include "docent/telepresence/server/session.h"

#include <gtest/gtest.h>

#include <atomic>
#include <boost/asio/io_context.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/read.hpp>
#include <optional>
#include <thread>

#include "docent/telepresence/server/test_client.h"

namespace docent::telepresence {
namespace {

using boost::asio::ip::tcp;

constexpr ViewerId kViewer = 7;
const std::string kUuid = "018f3a6c-5b2e-7c3d-9a4b-0123456789ab";
const std::string kChoice = R"({"type":"choice","id":")" + kUuid + R"(","prompt":"p","choice":"more"})";

/// One session on a thread of its own, and the bare socket at its other end.
class SessionTest : public testing::Test {
 protected:
  void open(Role role, const WebServerParams& params = {}) {
    owner_.message = [this](const Caller& caller, const ClientMessage&) {
      heard_ += caller.id;
      role_ = caller.role;
    };
    owner_.left = [this](const Caller&) { has_left_ = true; };
    owner_.latest = [](std::size_t slot) {
      return std::make_shared<const std::string>("slot " + std::to_string(slot));
    };
    owner_.detail_slots = 0b100;
    client_.emplace(acceptor_.local_endpoint().port());
    thread_ = std::thread{[this, role, params] { serve(role, params); }};
    ASSERT_TRUE(client_->upgrade());
  }
  void serve(Role role, const WebServerParams& params) {
    tcp::socket socket = acceptor_.accept();
    boost::beast::flat_buffer buffer;
    boost::beast::http::request<boost::beast::http::string_body> request;
    boost::beast::http::read(socket, buffer, request);
    std::make_shared<Session>(owner_, params, std::move(socket), Caller{kViewer, role, ""}, false)
        ->run(std::move(request), 0b10, false);
    io_.run();
  }
  void TearDown() override {
    client_.reset();
    thread_.join();
    EXPECT_TRUE(has_left_);
    EXPECT_EQ(owner_.connections, 0U);
  }

  SessionOwner owner_;
  std::atomic<ViewerId> heard_{0};          ///< sum over the messages
  std::atomic<Role> role_{Role::observer};  ///< of the last message
  bool has_left_ = false;
  boost::asio::io_context io_{1};
  tcp::acceptor acceptor_{io_, {boost::asio::ip::address_v4::loopback(), 0}};
  std::optional<TestClient> client_;
  std::thread thread_;
};

TEST_F(SessionTest, AVisitorGetsTheSlotsAndIsHeard) {
  open(Role::visitor);
  EXPECT_EQ(client_->receive_frame().payload, "slot 1");
  client_->send_frame(R"({"type":"watch","details":true})");
  EXPECT_EQ(client_->receive_frame().payload, "slot 2");
  client_->send_frame(kChoice);
  client_->send_frame("nonsense");  // its end comes after the choice was heard
  EXPECT_EQ(client_->receive_frame().close_code(), 1008);
  EXPECT_EQ(owner_.messages_in, 3U);
  EXPECT_EQ(owner_.messages_refused, 1U);
  EXPECT_EQ(heard_, kViewer);
}

TEST_F(SessionTest, AnObserverMayOnlyWatch) {
  open(Role::observer);
  EXPECT_EQ(client_->receive_frame().payload, "slot 1");
  client_->send_frame(R"({"type":"watch","details":true})");
  EXPECT_EQ(client_->receive_frame().payload, "slot 2");
  client_->send_frame(kChoice);
  const auto frame = client_->receive_frame();
  EXPECT_EQ(frame.close_code(), 1008);
  EXPECT_NE(frame.payload.find("not yours"), std::string::npos);
  EXPECT_EQ(heard_, 0U);
}

TEST_F(SessionTest, OnlyTheRobotsScreenSaysWhichButtonsAreLit) {
  open(Role::kiosk);
  EXPECT_EQ(client_->receive_frame().payload, "slot 1");
  client_->send_frame(R"({"type":"lamps","lit":[1]})");
  client_->send_frame("nonsense");  // its end comes after the lamps were heard
  EXPECT_EQ(client_->receive_frame().close_code(), 1008);
  EXPECT_EQ(heard_, kViewer);
  EXPECT_EQ(role_, Role::kiosk);
}

TEST_F(SessionTest, AVisitorSaysNothingOfLamps) {
  open(Role::visitor);
  EXPECT_EQ(client_->receive_frame().payload, "slot 1");
  client_->send_frame(R"({"type":"lamps","lit":[1]})");
  EXPECT_EQ(client_->receive_frame().close_code(), 1008);
  EXPECT_EQ(heard_, 0U);
}

TEST_F(SessionTest, WhoSaysTooMuchIsToldSo) {
  WebServerParams params;
  params.message_burst = 1;
  params.messages_per_second = 1e-6;
  open(Role::visitor, params);
  EXPECT_EQ(client_->receive_frame().payload, "slot 1");
  for (int i = 0; i < 2; ++i) client_->send_frame(kChoice);
  EXPECT_NE(client_->receive_frame().payload.find("too_fast"), std::string::npos);
  EXPECT_EQ(heard_, kViewer);
}

}  // namespace
}  // namespace docent::telepresence
