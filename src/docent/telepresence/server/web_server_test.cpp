#include "docent/telepresence/server/web_server.h"

#include <gtest/gtest.h>

#include <chrono>
#include <mutex>
#include <set>
#include <thread>

#include "docent/telepresence/server/test_client.h"

namespace docent::telepresence {
namespace {

using namespace std::chrono_literals;

const std::string kRequest =
    R"({"type":"request","id":"018f3a6c-5b2e-7c3d-9a4b-0123456789ab","kind":"exhibit","target":"sputnik"})";

class WebServerTest : public testing::Test {
 protected:
  void start(WebServerParams params = {}, const std::string& screen_key = "") {
    params.port = 0;
    site_->set_document("/", "text/html; charset=utf-8", "<p>hello");
    auto server = WebServer::start(params, site_,
                                   {.message =
                                        [this](const Caller& caller, const ClientMessage& message) {
                                          const std::scoped_lock lock{mutex_};
                                          messages_.emplace_back(caller.id, message);
                                        },
                                    .screen_key = screen_key,
                                    .desk = desk_});
    ASSERT_TRUE(server) << server.error().message;
    server_ = std::move(*server);
  }
  std::vector<std::pair<ViewerId, ClientMessage>> messages() {
    const std::scoped_lock lock{mutex_};
    return messages_;
  }
  template <class Predicate>
  static bool eventually(Predicate predicate) {
    for (int i = 0; i < 300; ++i) {
      if (predicate()) return true;
      std::this_thread::sleep_for(10ms);
    }
    return false;
  }
  std::mutex mutex_;
  std::vector<std::pair<ViewerId, ClientMessage>> messages_;
  std::shared_ptr<Site> site_ = std::make_shared<Site>();
  std::shared_ptr<ApiDesk> desk_;
  std::unique_ptr<WebServer> server_;
};

TEST_F(WebServerTest, AnswersHttp) {
  start();
  TestClient client{server_->port()};
  client.send("GET / HTTP/1.1\r\nHost: localhost\r\n\r\n");
  auto [head, body] = client.receive_reply();
  EXPECT_TRUE(head.starts_with("HTTP/1.1 200")) << head;
  EXPECT_NE(head.find("Content-Security-Policy: "), std::string::npos);
  EXPECT_NE(head.find("X-Content-Type-Options: nosniff"), std::string::npos);
  EXPECT_EQ(body, "<p>hello");
  // The connection is kept, and HEAD has no body.
  client.send(
      "HEAD / HTTP/1.1\r\nHost: localhost\r\n\r\nGET /nothing HTTP/1.1\r\nHost: localhost\r\nConnection: "
      "close\r\n\r\n");
  const std::string rest = client.receive_all();
  EXPECT_NE(rest.find("Content-Length: 8\r\n"), std::string::npos);
  EXPECT_EQ(rest.find("<p>hello"), std::string::npos);
  EXPECT_NE(rest.find("HTTP/1.1 404"), std::string::npos);
}

TEST_F(WebServerTest, SendsCompressedToWhoeverTakesIt) {
  start();
  const std::string text(5000, 'a');
  site_->set_document("/long", "text/css; charset=utf-8", text);
  TestClient client{server_->port()};
  const auto get = [&](const std::string& path, const std::string& accepted) {
    client.send("GET " + path + " HTTP/1.1\r\nHost: localhost\r\n" + accepted + "\r\n");
    return client.receive_reply();
  };
  const auto [packed_head, packed] = get("/long", "Accept-Encoding: gzip, deflate, br\r\n");
  EXPECT_NE(packed_head.find("Content-Encoding: gzip\r\n"), std::string::npos) << packed_head;
  EXPECT_NE(packed_head.find("Content-Type: text/css; charset=utf-8\r\n"), std::string::npos);
  EXPECT_NE(packed_head.find("Vary: Accept-Encoding\r\n"), std::string::npos);
  EXPECT_LT(packed.size(), 200U);
  EXPECT_TRUE(packed.starts_with("\x1f\x8b"));
  for (const char* accepted : {"", "Accept-Encoding: br\r\n", "Accept-Encoding: gzip;q=0\r\n"}) {
    const auto [head, body] = get("/long", accepted);
    EXPECT_EQ(head.find("Content-Encoding"), std::string::npos) << accepted;
    EXPECT_NE(head.find("Vary: Accept-Encoding\r\n"), std::string::npos) << "a cache must know of both";
    EXPECT_EQ(body, text);
  }
  const auto [head, body] = get("/", "Accept-Encoding: gzip\r\n");
  EXPECT_EQ(head.find("Content-Encoding"), std::string::npos);
  EXPECT_EQ(body, "<p>hello");
}

TEST_F(WebServerTest, RefusesWhatIsNotMeantForIt) {
  start();
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"POST / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 2\r\n\r\nhi", "HTTP/1.1 405"},
      {"GET /../../etc/passwd HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n", "HTTP/1.1 404"},
      {"GET /audio/..%2f..%2fetc%2fpasswd HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n", "HTTP/1.1 404"},
      {"GET / HTTP/1.1\r\nX: " + std::string(20000, 'x') + "\r\n\r\n", "HTTP/1.1 413"},
      {"POST / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 99999999\r\n\r\n", "HTTP/1.1 413"},
      {"\x16\x03\x01garbage\r\n\r\n", "HTTP/1.1 400"},
      {"GET /other HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
       "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n\r\n",
       "HTTP/1.1 404"},
  };
  for (const auto& [request, expected] : cases) {
    TestClient client{server_->port()};
    client.send(request);
    EXPECT_TRUE(client.receive_all().starts_with(expected)) << request.substr(0, 60);
  }
}

TEST_F(WebServerTest, AViewerGetsThePresentThenTheChanges) {
  start();
  server_->broadcast(0, "old");
  server_->broadcast(0, "pose 1");
  server_->broadcast(3, "mission 1");
  TestClient client{server_->port()};
  ASSERT_TRUE(client.upgrade());
  std::set<std::string> first{client.receive_frame().payload, client.receive_frame().payload};
  EXPECT_EQ(first, (std::set<std::string>{"pose 1", "mission 1"}));
  server_->broadcast(0, "pose 2");
  EXPECT_EQ(client.receive_frame().payload, "pose 2");
  EXPECT_EQ(server_->figures().viewers, 1U);
}

TEST_F(WebServerTest, DetailsAreForThoseWhoAsk) {
  start();
  server_->restrict_to(Stream::details, 7);
  TestClient curious{server_->port()};
  TestClient plain{server_->port()};
  ASSERT_TRUE(curious.upgrade());
  ASSERT_TRUE(plain.upgrade());
  server_->broadcast(7, "window 1");
  curious.send_frame(R"({"type":"watch","details":true})");
  EXPECT_EQ(curious.receive_frame().payload, "window 1");
  server_->broadcast(7, "window 2");
  server_->broadcast(1, "belief");
  EXPECT_EQ(plain.receive_frame().payload, "belief");
  const std::set<std::string> both{curious.receive_frame().payload, curious.receive_frame().payload};
  EXPECT_EQ(both, (std::set<std::string>{"window 2", "belief"}));
  EXPECT_EQ(plain.receive_frame(100ms).opcode, -1);
}

TEST_F(WebServerTest, WhoWantsLittleGetsThePoseAlone) {
  WebServerParams params;
  params.full_viewers = 2;
  start(params, "key");
  server_->restrict_to(Stream::full, 0);
  server_->restrict_to(Stream::thin, 1);
  TestClient full{server_->port()};
  TestClient thin{server_->port()};
  TestClient third{server_->port()};  // one too many for all that moves
  ASSERT_TRUE(full.upgrade());
  ASSERT_TRUE(thin.upgrade("", "/live?thin"));
  ASSERT_TRUE(third.upgrade());
  server_->broadcast(0, "all that moves");
  server_->broadcast(1, "pose");
  server_->broadcast(2, "mission");
  const auto two = [](TestClient& client) {
    return std::set<std::string>{client.receive_frame().payload, client.receive_frame().payload};
  };
  EXPECT_EQ(two(full), (std::set<std::string>{"all that moves", "mission"}));
  EXPECT_EQ(two(thin), (std::set<std::string>{"pose", "mission"}));
  EXPECT_EQ(two(third), (std::set<std::string>{"pose", "mission"}));
  TestClient screen{server_->port()};
  ASSERT_TRUE(screen.upgrade("", "/live?screen=key"));
  EXPECT_EQ(two(screen), (std::set<std::string>{"all that moves", "mission"})) << "the robot's own";
  // Who changes their mind gets the present at once.
  thin.send_frame(R"({"type":"watch","details":false,"thin":false})");
  EXPECT_EQ(thin.receive_frame().payload, "all that moves");
  third.send_frame(R"({"type":"watch","details":false,"thin":false})");
  EXPECT_EQ(third.receive_frame(200ms).opcode, -1);
}

TEST_F(WebServerTest, HandsMessagesOverAndAnswersTheirSender) {
  start();
  TestClient client{server_->port()};
  TestClient other{server_->port()};
  ASSERT_TRUE(client.upgrade());
  ASSERT_TRUE(other.upgrade());
  client.send_frame(kRequest);
  ASSERT_TRUE(eventually([&] { return !messages().empty(); }));
  const auto [viewer, message] = messages().front();
  EXPECT_EQ(std::get<RequestMessage>(message).target, "sputnik");
  server_->send(viewer, "yours");
  EXPECT_EQ(client.receive_frame().payload, "yours");
  EXPECT_EQ(other.receive_frame(200ms).opcode, -1);
}

TEST_F(WebServerTest, GarbageEndsTheConnectionWithAReason) {
  start();
  const std::vector<std::tuple<std::string, int, int>> cases = {
      {"hello", 1, 1008},                 // not JSON
      {R"({"type":"drive"})", 1, 1008},   // nothing a visitor may say
      {"\x01\x02", 2, 1003},              // binary
      {std::string(5000, 'x'), 1, 1009},  // too long
      {"\xff\xfe", 1, 1007},              // not UTF-8
  };
  for (const auto& [payload, opcode, code] : cases) {
    TestClient client{server_->port()};
    ASSERT_TRUE(client.upgrade());
    client.send_frame(payload, opcode);
    const auto frame = client.receive_frame();
    EXPECT_EQ(frame.opcode, 8) << code;
    EXPECT_EQ(frame.close_code(), code) << frame.payload;
    if (code == 1008) {
      EXPECT_GT(frame.payload.size(), 4U);
    }
    // says why
  }
  EXPECT_TRUE(messages().empty());
  EXPECT_TRUE(eventually([&] { return server_->figures().viewers == 0; }));
}

TEST_F(WebServerTest, ABrokenFrameEndsOnlyItsOwnConnection) {
  start();
  TestClient good{server_->port()};
  ASSERT_TRUE(good.upgrade());
  for (const std::string& bytes :
       {std::string{"\x81\x05hello", 7}, std::string{"\xf1\x80\0\0\0\0", 6}, std::string{"\x8f\x80\0\0\0\0", 6},
        std::string{"\x81\xff\xff\xff\xff\xff\xff\xff\xff\xff\0\0\0\0", 14}}) {
    TestClient client{server_->port()};
    ASSERT_TRUE(client.upgrade());
    client.send(bytes);
    EXPECT_NE(client.receive_frame().opcode, 1);
  }
  server_->broadcast(0, "still here");
  EXPECT_EQ(good.receive_frame().payload, "still here");
}

TEST_F(WebServerTest, TooManyMessagesAreRefusedThenCutOff) {
  WebServerParams params;
  params.message_burst = 5;
  params.messages_per_second = 0.001;
  start(params);
  TestClient client{server_->port()};
  ASSERT_TRUE(client.upgrade());
  for (int i = 0; i < 8; ++i) client.send_frame(kRequest);
  EXPECT_NE(client.receive_frame().payload.find("too_fast"), std::string::npos);
  ASSERT_TRUE(eventually([&] { return server_->figures().messages_in == 8; }));
  EXPECT_EQ(messages().size(), 5U);
  for (int i = 0; i < 200; ++i) client.send_frame(kRequest);
  TestClient::Frame frame;
  do frame = client.receive_frame();
  while (frame.opcode == 1);
  EXPECT_EQ(frame.close_code(), 1008);
  EXPECT_EQ(messages().size(), 5U);
}

TEST_F(WebServerTest, ASlowViewerGetsTheLatestAndHarmsNobody) {
  WebServerParams params;
  params.send_buffer_bytes = 8192;
  start(params);
  TestClient slow{server_->port(), 4096};
  TestClient quick{server_->port()};
  ASSERT_TRUE(slow.upgrade());
  ASSERT_TRUE(quick.upgrade());
  const std::string filler(50000, '.');
  constexpr int kValues = 400;
  TestClient::Frame frame;
  for (int i = 0; i < kValues; ++i) {
    server_->broadcast(0, std::to_string(i) + filler);
    frame = quick.receive_frame();
    ASSERT_TRUE(frame.payload.starts_with(std::to_string(i) + "."));  // the quick one misses nothing meanwhile
  }
  const std::string last = std::to_string(kValues - 1) + ".";
  // 20 MB were shown; the slow one now reads what is under way and then at once the last value.
  int seen = 0;
  do {
    frame = slow.receive_frame();
    ++seen;
  } while (frame.opcode == 1 && !frame.payload.starts_with(last));
  EXPECT_EQ(frame.opcode, 1);
  EXPECT_LT(seen, kValues / 2);
  EXPECT_GT(server_->figures().values_skipped, 0U);
}

TEST_F(WebServerTest, ViewersAreCounted) {
  WebServerParams params;
  params.max_viewers = 2;
  start(params);
  {
    TestClient first{server_->port()};
    TestClient second{server_->port()};
    ASSERT_TRUE(first.upgrade());
    ASSERT_TRUE(second.upgrade());
    TestClient third{server_->port()};
    EXPECT_FALSE(third.upgrade());
  }
  EXPECT_TRUE(eventually([&] { return server_->figures().viewers == 0; }));
  TestClient again{server_->port()};
  EXPECT_TRUE(again.upgrade());
}

TEST_F(WebServerTest, ManyViewersAreServedInGroups) {
  start();
  std::vector<std::unique_ptr<TestClient>> clients;
  for (int i = 0; i < 150; ++i) {
    clients.push_back(std::make_unique<TestClient>(server_->port()));
    ASSERT_TRUE(clients.back()->upgrade());
  }
  for (const char* value : {"a", "b"}) {
    server_->broadcast(0, value);
    for (const auto& client : clients) EXPECT_EQ(client->receive_frame().payload, value);
  }
  clients.resize(1);
  ASSERT_TRUE(eventually([&] { return server_->figures().viewers == 1; }));
  server_->broadcast(0, "c");
  EXPECT_EQ(clients.front()->receive_frame().payload, "c");
}

TEST_F(WebServerTest, PagesOfOtherSitesMayNotSpeakForTheirReaders) {
  WebServerParams params;
  params.origins = {"museum.test"};
  start(params);
  for (const char* origin : {"http://localhost", "https://localhost", "https://museum.test"}) {
    TestClient client{server_->port()};
    EXPECT_TRUE(client.upgrade(std::string{"Origin: "} + origin + "\r\n")) << origin;
  }
  for (const char* origin : {"https://evil.test", "null", "http://localhost.evil.test"}) {
    TestClient client{server_->port()};
    EXPECT_FALSE(client.upgrade(std::string{"Origin: "} + origin + "\r\n")) << origin;
  }
}

TEST_F(WebServerTest, StrangersLeaveConnectionsForThisComputer) {
  WebServerParams params;
  params.max_connections = 250;
  params.connections_of_address = 120;
  start(params);
  std::vector<std::unique_ptr<TestClient>> clients;
  const auto is_served = [&](const char* from) {
    clients.push_back(std::make_unique<TestClient>(server_->port(), 0, from));
    clients.back()->send("GET / HTTP/1.1\r\nHost: localhost\r\n\r\n");
    return clients.back()->receive();
  };
  int served = 0;
  for (int i = 0; i < 130; ++i) served += is_served("127.0.0.2");
  EXPECT_EQ(served, 120) << "of one address";
  for (int i = 0; i < 40; ++i) served += is_served("127.0.0.3");
  EXPECT_EQ(served, 150) << "a hundred are kept";
  for (int i = 0; i < 20; ++i) EXPECT_TRUE(is_served("127.0.0.1")) << "the robot's own screen, or a proxy";
}

TEST_F(WebServerTest, APortInUseIsSaid) {
  start();
  WebServerParams params;
  params.port = server_->port();
  const auto second = WebServer::start(params, site_, {});
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().message,
            "127.0.0.1:" + std::to_string(params.port) + ": the port is in use by another program");
  params.address = "no address";
  EXPECT_FALSE(WebServer::start(params, site_, {}));
}

TEST_F(WebServerTest, EndsWithViewersConnected) {
  start();
  TestClient client{server_->port()};
  ASSERT_TRUE(client.upgrade());
  const int port = server_->port();
  server_.reset();
  EXPECT_NE(client.receive_frame().opcode, 1);
  WebServerParams params;
  params.port = port;
  EXPECT_TRUE(WebServer::start(params, site_, {}));  // the port is free at once
}

}  // namespace
}  // namespace docent::telepresence
