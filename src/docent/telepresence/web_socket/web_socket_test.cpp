#include "docent/telepresence/web_socket/web_socket.h"

#include <gtest/gtest.h>

#include <boost/asio/io_context.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/read.hpp>
#include <optional>

namespace docent::telepresence {
namespace {

namespace beast = boost::beast;
using boost::asio::ip::tcp;

/// A server's end and a client's, in one thread: each step runs until both have done what they were asked.
class WebSocketTest : public testing::Test {
 protected:
  void open(const WebSocketManner& of_server, const WebSocketManner& of_client = {}) {
    tcp::acceptor acceptor{io_, {boost::asio::ip::address_v4::loopback(), 0}};
    tcp::socket near{io_}, far{io_};
    far.connect(acceptor.local_endpoint());
    acceptor.accept(near);
    client_.emplace(std::move(far), of_client);
    client_->greet("museum:80", "/live?thin=1", [this](WebSocket::Error error) { greeted_ = error; });
    beast::flat_buffer buffer;
    HttpRequest request;
    // What is asked is on its way once the client's part has run, and an HTTP connection has read it by then.
    io_.poll();
    beast::http::read(near, buffer, request);
    target_ = std::string{request.target()};
    server_.emplace(std::move(near), of_server);
    server_->accept(std::move(request), [this](WebSocket::Error error) { accepted_ = error; });
    run_until([this] { return greeted_ && accepted_; });
  }
  template <class Condition>
  void run_until(Condition done) {
    io_.restart();
    while (!done() && io_.run_one_for(std::chrono::seconds{20}) > 0) {
    }
    ASSERT_TRUE(done());
  }
  struct Message {
    WebSocket::Error error;
    std::string text;
    bool is_text = false;
  };
  Message sent(WebSocket& from, WebSocket& to, const std::string& text, bool is_text) {
    std::optional<WebSocket::Error> wrote;
    std::optional<Message> heard;
    to.read([&](WebSocket::Error error, std::string message, bool was_text) {
      heard = Message{error, std::move(message), was_text};
    });
    from.write(text, is_text, [&](WebSocket::Error error) { wrote = error; });
    run_until([&] { return heard && wrote; });
    return heard.value_or(Message{});
  }

  boost::asio::io_context io_{1};
  std::optional<WebSocket> server_, client_;
  std::optional<WebSocket::Error> greeted_, accepted_;
  std::string target_;
};

/// Both ends of an encrypted line, with their keys. @returns what came of it at the server's and the client's
std::pair<WebSocket::Error, WebSocket::Error> secured(boost::asio::io_context& io, const std::string& server_key,
                                                      const std::string& client_key) {
  tcp::acceptor acceptor{io, {boost::asio::ip::address_v4::loopback(), 0}};
  tcp::socket near{io}, far{io};
  far.connect(acceptor.local_endpoint());
  acceptor.accept(near);
  WebSocket server{std::move(near), {}, pre_shared(server_key)};
  WebSocket client{std::move(far), {}, pre_shared(client_key)};
  std::optional<WebSocket::Error> at_server, at_client;
  std::string heard;
  server.secure(true, [&](WebSocket::Error error) {
    if (error) return void(at_server = error);
    server.accept([&](WebSocket::Error failed) {
      if (failed) return void(at_server = failed);
      server.read([&](WebSocket::Error lost, std::string message, bool) {
        at_server = lost;
        heard = std::move(message);
      });
    });
  });
  client.secure(false, [&](WebSocket::Error error) {
    if (error) return void(at_client = error);
    client.greet("museum:80", "/uplink", [&](WebSocket::Error failed) {
      if (failed) return void(at_client = failed);
      client.write("hello", false, [&](WebSocket::Error lost) { at_client = lost; });
    });
  });
  io.restart();
  while (!(at_server && at_client) && io.run_one_for(std::chrono::seconds{20}) > 0) {
  }
  EXPECT_TRUE(at_server && at_client);
  EXPECT_EQ(heard, at_server && !*at_server ? "hello" : "");
  server.drop();
  client.drop();
  io.restart();
  io.run_for(std::chrono::seconds{5});
  return {at_server.value_or(WebSocket::Error{}), at_client.value_or(WebSocket::Error{})};
}

TEST(EncryptedLine, IsOpenedByWhoeverHasTheKeyAlone) {
  boost::asio::io_context io{1};
  const std::string key = "0123456789abcdef0123456789abcdef";
  const auto [server, client] = secured(io, key, key);
  EXPECT_FALSE(server) << server.message();
  EXPECT_FALSE(client) << client.message();
  const auto [refused, sent_away] = secured(io, key, "0123456789abcdef0123456789abcdeF");
  EXPECT_TRUE(refused);
  EXPECT_TRUE(sent_away);
}

TEST_F(WebSocketTest, MessagesComeWholeBothWays) {
  open({});
  EXPECT_FALSE(*greeted_);
  EXPECT_FALSE(*accepted_);
  EXPECT_EQ(target_, "/live?thin=1");
  const std::string large(60'000, 'x');
  for (const std::string& text : {std::string{"pose"}, std::string{}, large}) {
    const Message down = sent(*server_, *client_, text, true);
    EXPECT_FALSE(down.error);
    EXPECT_EQ(down.text, text);
    EXPECT_TRUE(down.is_text);
    const Message up = sent(*client_, *server_, text, false);
    EXPECT_EQ(up.text, text);
    EXPECT_FALSE(up.is_text);
  }
}

TEST_F(WebSocketTest, CompressedMessagesComeTheSame) {
  open({.compresses = true}, {.compresses = true});
  const std::string text(5'000, 'y');
  EXPECT_EQ(sent(*server_, *client_, text, true).text, text);
  EXPECT_EQ(sent(*client_, *server_, text, false).text, text);
}

TEST_F(WebSocketTest, AMessageThatIsTooLongEndsIt) {
  open({.longest_message = 1'000});
  EXPECT_FALSE(sent(*client_, *server_, std::string(1'000, 'x'), true).error);
  std::optional<WebSocket::Error> told;  // a server that gives up says so and waits for the client to go
  client_->read([&](WebSocket::Error error, const std::string&, bool) { told = error; });
  const Message heard = sent(*client_, *server_, std::string(1'001, 'x'), true);
  EXPECT_TRUE(WebSocket::is_too_long(heard.error));
  run_until([&] { return told.has_value(); });
  EXPECT_TRUE(*told);
}

TEST_F(WebSocketTest, GoodbyeReachesTheOther) {
  open({});
  std::optional<WebSocket::Error> closed, heard;
  client_->read([&](WebSocket::Error error, const std::string&, bool) { heard = error; });
  server_->close(CloseCode::policy_error, "not yours", [&](WebSocket::Error error) { closed = error; });
  run_until([&] { return closed && heard; });
  EXPECT_FALSE(*closed);
  EXPECT_TRUE(*heard);
  EXPECT_FALSE(WebSocket::is_too_long(*heard));
}

TEST_F(WebSocketTest, WhatIsUnderWayFailsWhenItIsDropped) {
  open({});
  std::optional<WebSocket::Error> near, far;
  server_->read([&](WebSocket::Error error, const std::string&, bool) { near = error; });
  client_->read([&](WebSocket::Error error, const std::string&, bool) { far = error; });
  server_->drop();
  server_.reset();  // what is under way keeps what it needs
  run_until([&] { return near && far; });
  EXPECT_TRUE(*near);
  EXPECT_TRUE(*far);
}

HttpRequest offering(const std::vector<std::string>& lines) {
  HttpRequest request;
  for (const std::string& line : lines) request.insert(beast::http::field::sec_websocket_protocol, line);
  return request;
}

TEST(ASubProtocol, IsTheFirstOfTheClientsThatTheServerSpeaks) {
  const std::vector<std::string> spoken{"new.v1", "old.v1"};
  EXPECT_EQ(agreed_protocol(offering({"old.v1"}), spoken), "old.v1");
  EXPECT_EQ(agreed_protocol(offering({"other, new.v1,old.v1"}), spoken), "new.v1");
  EXPECT_EQ(agreed_protocol(offering({"old.v1 , new.v1"}), spoken), "old.v1");
  EXPECT_EQ(agreed_protocol(offering({"other", "new.v1"}), spoken), "new.v1") << "in two lines";
  EXPECT_EQ(agreed_protocol(offering({}), spoken), "") << "none is offered";
  EXPECT_EQ(agreed_protocol(offering({"other"}), spoken), std::nullopt);
  EXPECT_EQ(agreed_protocol(offering({"new.v10, NEW.V1"}), spoken), std::nullopt) << "names are compared as they stand";
}

}  // namespace
}  // namespace docent::telepresence
