#include "docent/telepresence/server/http_connection.h"

#include <gtest/gtest.h>

#include <chrono>
#include <future>
#include <mutex>
#include <thread>
#include <vector>

#include "docent/telepresence/foxglove/hub.h"
#include "docent/telepresence/server/test_client.h"
#include "docent/telepresence/server/web_server.h"

namespace docent::telepresence {
namespace {

using namespace std::chrono_literals;

/// Answers from another thread, what the tests want; knows one operator.
class ADesk final : public ApiDesk {
 public:
  ~ADesk() override {
    for (std::thread& thread : threads_) thread.join();
  }
  void take(ApiRequest request, std::function<void(ApiReply)> answer) override {
    const std::scoped_lock lock{mutex_};
    requests_.push_back(request);
    threads_.emplace_back([answer = std::move(answer), delay = delay] {
      std::this_thread::sleep_for(delay);
      answer({200, R"({"ok":true})", "docent_login=abc; Path=/; HttpOnly"});
    });
  }
  void admit(std::string token, std::function<void(Admitted)> answer) override {
    const std::scoped_lock lock{mutex_};
    threads_.emplace_back([token = std::move(token), answer = std::move(answer)] {
      if (token == "odd") return answer(fail("the database does not answer"));
      answer(token == "good" ? std::optional{Admission{"ada", "login of ada"}} : std::nullopt);
    });
  }
  std::vector<ApiRequest> requests() {
    const std::scoped_lock lock{mutex_};
    return requests_;
  }
  void when_ended(std::function<void(const std::string&)> told) override {
    const std::scoped_lock lock{mutex_};
    ended_ = std::move(told);
  }
  void ended(const std::string& login) {
    const std::scoped_lock lock{mutex_};
    ended_(login);
  }
  std::chrono::milliseconds delay{0};

 private:
  std::mutex mutex_;
  std::vector<ApiRequest> requests_;
  std::vector<std::thread> threads_;
  std::function<void(const std::string&)> ended_;
};

class HttpConnections : public testing::Test {
 protected:
  void start(WebServerParams params = {}) {
    params.port = 0;
    auto server = WebServer::start(params, std::make_shared<Site>(),
                                   {.message =
                                        [this](const Caller& caller, const ClientMessage& message) {
                                          const std::scoped_lock lock{mutex_};
                                          heard_.emplace_back(caller, message);
                                        },
                                    .arrived =
                                        [this](const std::string& address) {
                                          const std::scoped_lock lock{mutex_};
                                          arrived_.push_back(address);
                                        },
                                    .left = [this](const Caller& caller) { left_.set_value(caller.name); },
                                    .foxglove = hub_,
                                    .desk = desk_});
    ASSERT_TRUE(server) << server.error().message;
    server_ = std::move(*server);
  }
  std::pair<std::string, std::string> call(const std::string& line, const std::string& headers = "",
                                           const std::string& body = "") const {
    TestClient client{server_->port()};
    client.send(line + " HTTP/1.1\r\nHost: localhost\r\n" + headers +
                (body.empty() ? "" : "Content-Length: " + std::to_string(body.size()) + "\r\n") + "\r\n" + body);
    return client.receive_reply();
  }
  std::mutex mutex_;
  std::vector<std::pair<Caller, ClientMessage>> heard_;
  std::vector<std::string> arrived_;
  std::promise<std::string> left_;
  std::shared_ptr<FoxgloveHub> hub_ =
      std::make_shared<FoxgloveHub>("robot", std::vector<FoxgloveChannel>{}, [](std::uint32_t) {});
  /// What the server answers to a viewer of ROS 2 that opens /foxglove.
  [[nodiscard]] std::string opened(const std::string& headers) const {
    TestClient client{server_->port()};
    client.send(
        "GET /foxglove HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Key: "
        "dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n" +
        headers + "\r\n");
    return client.receive_reply().first;
  }
  std::shared_ptr<ADesk> desk_ = std::make_shared<ADesk>();
  std::unique_ptr<WebServer> server_;
};

TEST_F(HttpConnections, HandCallsToTheDeskAndAnswersBack) {
  start();
  const auto [head, body] = call("PUT /api/v1/posts/1?x=2",
                                 "Content-Type: application/json; charset=utf-8\r\nCookie: a=1; docent_login=tok\r\n"
                                 "Docent-Csrf: c\r\nOrigin: http://localhost\r\n",
                                 "{}");
  EXPECT_TRUE(head.starts_with("HTTP/1.1 200")) << head;
  for (const char* wanted :
       {"Cache-Control: no-store", "Set-Cookie: docent_login=abc; Path=/; HttpOnly", "Content-Type: application/json",
        "Content-Security-Policy: ", "X-Content-Type-Options: nosniff"})
    EXPECT_NE(head.find(wanted), std::string::npos) << head;
  EXPECT_EQ(body, R"({"ok":true})");
  ASSERT_EQ(desk_->requests().size(), 1U);
  const ApiRequest request = desk_->requests()[0];
  EXPECT_EQ(request.method, "PUT");
  EXPECT_EQ(request.target, "/api/v1/posts/1?x=2");
  EXPECT_EQ(request.body, "{}");
  EXPECT_EQ(request.token, "tok");
  EXPECT_EQ(request.csrf, "c");
  EXPECT_EQ(request.address, "127.0.0.1");
  EXPECT_TRUE(request.is_json && request.is_of_ours);
}

TEST_F(HttpConnections, SayWhatComesFromAnotherSite) {
  start();
  (void)call("POST /api/v1/forum", "Content-Type: text/plain\r\nOrigin: http://evil.test\r\n", "{}");
  ASSERT_EQ(desk_->requests().size(), 1U);
  EXPECT_FALSE(desk_->requests()[0].is_of_ours);
  EXPECT_FALSE(desk_->requests()[0].is_json);
}

TEST_F(HttpConnections, RefuseWhatIsTooLarge) {
  start();
  const std::string large(kLongestBody + 1, 'x');
  EXPECT_TRUE(call("POST /api/v1/forum", "", large).first.starts_with("HTTP/1.1 413"));
  EXPECT_TRUE(call("GET /api/v1/forum", "X: " + std::string(9000, 'x') + "\r\n").first.starts_with("HTTP/1.1 413"));
  EXPECT_TRUE(desk_->requests().empty());
}

TEST_F(HttpConnections, AreCalledByANameOfOurs) {
  WebServerParams params;
  params.hosts = {"robot.museum.example"};
  start(params);
  for (const auto& [host, status] : {std::pair{"localhost", "404"},
                                     {"127.0.0.1", "404"},
                                     {"robot.museum.example", "404"},
                                     {"evil.example", "421"}}) {
    for (const char* what : {"", "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"}) {
      TestClient client{server_->port()};
      client.send(std::string{"GET /nothing HTTP/1.1\r\nHost: "} + host + "\r\n" + what + "\r\n");
      EXPECT_TRUE(client.receive_reply().first.starts_with(std::string{"HTTP/1.1 "} + status)) << host << what;
    }
  }
  EXPECT_TRUE(call("GET /api/v1/forum?x=" + std::string(3000, 'x')).first.starts_with("HTTP/1.1 414"));
}

TEST_F(HttpConnections, AnOperatorWhoHasLoggedOutIsGone) {
  start();
  TestClient operate{server_->port()};
  ASSERT_TRUE(operate.upgrade("Cookie: docent_login=good\r\n", "/operate"));
  TestClient other{server_->port()};
  ASSERT_TRUE(other.upgrade());
  desk_->ended("login of somebody else");
  desk_->ended("login of ada");
  EXPECT_EQ(left_.get_future().get(), "ada") << "also for the robot, whatever the browser does";
  operate.send_frame(R"({"type":"steer","pressed":true,"forward":1,"turn":0})");
  EXPECT_EQ(operate.receive_frame().close_code(), 1008);
  other.send_frame(R"({"type":"choice","id":"018f3a6c-5b2e-7c3d-9a4b-0123456789ab","prompt":"p","choice":"more"})");
  other.send_frame("nonsense");
  EXPECT_EQ(other.receive_frame().close_code(), 1008);
  const std::scoped_lock lock{mutex_};
  ASSERT_EQ(heard_.size(), 1U) << "the other viewer alone";
  EXPECT_EQ(heard_[0].first.role, Role::visitor);
}

TEST_F(HttpConnections, TakeAWholeMuseumButFewAtATime) {
  start();
  const std::string museum(kLongestBody + 1, 'x');
  const std::string ada = "Cookie: docent_login=good\r\n";
  EXPECT_TRUE(call("PUT /api/v1/museum", ada, museum).first.starts_with("HTTP/1.1 200"));
  EXPECT_EQ(desk_->requests().at(0).body, museum);
  EXPECT_TRUE(call("PUT /api/v1/museum", "", std::string(kLongestMuseum + 1, 'x')).first.starts_with("HTTP/1.1 413"));
  const auto begun_with = [](const std::string& headers) {
    return "PUT /api/v1/museum HTTP/1.1\r\nHost: localhost\r\n" + headers + "Content-Length: 500000\r\n\r\n{";
  };
  std::vector<std::unique_ptr<TestClient>> slow;
  for (int i = 0; i < 8; ++i) {
    slow.push_back(std::make_unique<TestClient>(server_->port()));
    slow.back()->send(begun_with("Cookie: docent_login=bad\r\n"));
    EXPECT_TRUE(slow.back()->receive_reply().first.starts_with("HTTP/1.1 403")) << "a stranger holds no place";
  }
  EXPECT_TRUE(call("PUT /api/v1/museum", ada, museum).first.starts_with("HTTP/1.1 200"));
  slow.clear();
  // Four that never end hold all the places; when they go, there is room again. One that comes while a place is still
  // held by whoever went before is refused, and another comes.
  const std::string begun = begun_with(ada);
  const auto status_is = [&](const std::string& wanted) {
    std::this_thread::sleep_for(std::chrono::milliseconds{20});
    return call("PUT /api/v1/museum", ada, museum).first.starts_with("HTTP/1.1 " + wanted);
  };
  while (slow.size() < 20 && (slow.size() < 4 || !status_is("503"))) {
    slow.push_back(std::make_unique<TestClient>(server_->port()));
    slow.back()->send(begun);
  }
  EXPECT_LT(slow.size(), 20U);
  EXPECT_TRUE(call("POST /api/v1/forum", "", "{}").first.starts_with("HTTP/1.1 200")) << "small ones are not held up";
  slow.clear();
  bool is_there_room = false;
  for (int i = 0; i < 100 && !is_there_room; ++i) is_there_room = status_is("200");
  EXPECT_TRUE(is_there_room);
}

TEST_F(HttpConnections, ServeOneCallAfterTheOther) {
  start();
  TestClient client{server_->port()};
  for (int i = 0; i < 5; ++i) {
    client.send("GET /api/v1/forum HTTP/1.1\r\nHost: localhost\r\n\r\n");
    EXPECT_TRUE(client.receive_reply().first.starts_with("HTTP/1.1 200")) << i;
  }
}

TEST_F(HttpConnections, BelieveAForwardedAddressFromAProxyOfOursAlone) {
  start();
  (void)call("GET /api/v1/forum", "X-Forwarded-For: 203.0.113.9\r\n");
  server_.reset();
  WebServerParams params;
  params.proxies = {"127.0.0.1"};
  start(params);
  (void)call("GET /api/v1/forum", "X-Forwarded-For: 1.1.1.1, 203.0.113.9\r\n");
  (void)call("GET /api/v1/forum", "X-Forwarded-For: 1.1.1.1\r\nX-Forwarded-For: 203.0.113.9\r\n");
  EXPECT_EQ(desk_->requests().at(2).address, "203.0.113.9") << "in a line of its own";
  EXPECT_EQ(desk_->requests().at(0).address, "127.0.0.1");
  EXPECT_EQ(desk_->requests().at(1).address, "203.0.113.9");
  TestClient viewer{server_->port()};
  ASSERT_TRUE(viewer.upgrade("X-Forwarded-For: 203.0.113.10\r\n"));
  const std::scoped_lock lock{mutex_};
  EXPECT_EQ(arrived_, std::vector<std::string>{"203.0.113.10"});
}

TEST_F(HttpConnections, BehindAProxyOfOursAreCalledByItsName) {
  const std::string forwarded =
      "X-Forwarded-Host: museum.example\r\nX-Forwarded-Proto: https\r\nX-Forwarded-Prefix: /robot\r\n";
  const std::string page = "Origin: https://museum.example\r\n";
  start();
  (void)call("GET /api/v1/forum", forwarded + page);
  EXPECT_FALSE(TestClient{server_->port()}.upgrade(forwarded + page)) << "nobody of ours says so";
  server_.reset();
  WebServerParams params;
  params.proxies = {"127.0.0.1"};
  start(params);
  const auto [head, body] = call("GET /api/v1/forum", forwarded + page);
  EXPECT_FALSE(desk_->requests().at(0).is_of_ours);
  EXPECT_TRUE(desk_->requests().at(1).is_of_ours);
  EXPECT_NE(head.find("Set-Cookie: docent_login=abc; Path=/robot/; HttpOnly; Secure\r\n"), std::string::npos) << head;
  EXPECT_TRUE(TestClient{server_->port()}.upgrade(forwarded + page));
  EXPECT_FALSE(TestClient{server_->port()}.upgrade(forwarded + "Origin: http://museum.example\r\n")) << "not by https";
  EXPECT_FALSE(TestClient{server_->port()}.upgrade(forwarded + "Origin: http://localhost\r\n")) << "the proxy's own";
}

TEST_F(HttpConnections, BelowTheirPrefixEverythingIsWhereItIsWithout) {
  WebServerParams params;
  params.prefix = "/museum/robot";
  start(params);
  for (const char* path : {"/museum/robot/api/v1/forum?x=1", "/api/v1/forum?x=1"}) {
    const bool is_below = path[1] == 'm';
    const auto [head, body] = call(std::string{"GET "} + path);
    EXPECT_TRUE(head.starts_with("HTTP/1.1 200")) << head;
    EXPECT_EQ(head.find("Path=/museum/robot/;") != std::string::npos, is_below) << head;
    EXPECT_EQ(head.find("Path=/;") != std::string::npos, !is_below) << head;
    EXPECT_EQ(desk_->requests().back().target, "/api/v1/forum?x=1");
    EXPECT_EQ(TestClient{server_->port()}.upgrade("", is_below ? "/museum/robot/live" : "/live"), true);
  }
  EXPECT_TRUE(call("GET /museum/robots/api/v1/forum").first.starts_with("HTTP/1.1 404"));
  const auto [head, body] = call("GET /museum/robot");
  EXPECT_TRUE(head.starts_with("HTTP/1.1 308")) << head;
  EXPECT_NE(head.find("Location: robot/\r\n"), std::string::npos) << head;
}

TEST_F(HttpConnections, AProxyThatPassesOnThePathMayNameItAsWell) {
  WebServerParams params;
  params.proxies = {"127.0.0.1"};
  params.prefix = "/robot";
  start(params);
  for (const auto& [named, path] : std::vector<std::pair<std::string, std::string>>{
           {"", "/robot/"}, {"/robot", "/robot/"}, {"/museum", "/museum/robot/"}}) {
    const auto [head, body] = call("GET /robot/api/v1/forum", "X-Forwarded-Prefix: " + named + "\r\n");
    EXPECT_NE(head.find("Path=" + path + ";"), std::string::npos) << head;
  }
}

TEST_F(HttpConnections, AgreeOnTheSubProtocolOfAFoxgloveClient) {
  WebServerParams params;
  params.foxglove_clients = 100;  // those who have just gone may not be missed yet
  start(params);
  for (const std::string name : {"foxglove.websocket.v1", "foxglove.sdk.v1"})
    for (const std::string others : {"", ", mqtt", ", foxglove.sdk.v2"}) {
      const std::string head = opened("Sec-WebSocket-Protocol: " + name + others + "\r\n");
      EXPECT_TRUE(head.starts_with("HTTP/1.1 101")) << head;
      EXPECT_NE(head.find("Sec-WebSocket-Protocol: " + name + "\r\n"), std::string::npos) << head;
    }
  EXPECT_TRUE(opened("Sec-WebSocket-Protocol: mqtt, foxglove.sdk.v2\r\n").starts_with("HTTP/1.1 400"));
  const std::string silent = opened("");  // a client that asks for none must not be told one (RFC 6455, 4.1)
  EXPECT_TRUE(silent.starts_with("HTTP/1.1 101")) << silent;
  EXPECT_EQ(silent.find("Sec-WebSocket-Protocol"), std::string::npos) << silent;
}

TEST_F(HttpConnections, ShowFoxgloveToProxiesWhereTheyMayHandOn) {
  for (const bool may : {false, true}) {
    for (const bool is_ours : {false, true}) {
      WebServerParams params;
      params.proxies = {is_ours ? "127.0.0.1" : "127.0.0.9"};
      params.foxglove_by_proxy = may;
      params.foxglove_clients = 100;
      start(params);
      for (const char* header : {"X-Forwarded-For: 203.0.113.9", "X-Forwarded-Host: localhost",
                                 "X-Forwarded-Proto: http", "Via: 1.1 museum"})
        EXPECT_EQ(opened(std::string{header} + "\r\n").starts_with("HTTP/1.1 101"), may && is_ours) << header;
      EXPECT_TRUE(opened("").starts_with("HTTP/1.1 101")) << "a program of this computer";
      server_.reset();
    }
  }
}

TEST(WebPrefix, IsAPathThatIsNoneOfThePagesOwn) {
  for (const char* good : {"", "/robot", "/museum/robot", "/apis"}) {
    WebServerParams params;
    params.prefix = good;
    EXPECT_TRUE(params.validate()) << good;
  }
  for (const char* bad : {"robot", "/", "/robot/", "/api", "/live/robot", "https://museum.example/robot"}) {
    WebServerParams params;
    params.prefix = bad;
    EXPECT_FALSE(params.validate()) << bad;
  }
}

TEST_F(HttpConnections, OfOneForwardedAddressThereAreSoManyLines) {
  WebServerParams params;
  params.proxies = {"127.0.0.1"};
  params.connections_of_address = 3;
  start(params);
  std::vector<std::unique_ptr<TestClient>> viewers;
  const auto comes_in = [&](const std::string& address) {
    viewers.push_back(std::make_unique<TestClient>(server_->port()));
    return viewers.back()->upgrade("X-Forwarded-For: " + address + "\r\n");
  };
  for (int i = 1; i <= 3; ++i) EXPECT_TRUE(comes_in("2001:db8:1:2::" + std::to_string(i)));
  EXPECT_FALSE(comes_in("2001:db8:1:2::4")) << "one household";
  EXPECT_TRUE(comes_in("2001:db8:1:3::1"));
  TestClient ada{server_->port()};
  EXPECT_TRUE(ada.upgrade("Cookie: docent_login=good\r\nX-Forwarded-For: 2001:db8:1:2::5\r\n", "/operate"));
}

TEST_F(HttpConnections, WhereNobodyCanBeRecognizedThatIsSaid) {
  start();
  TestClient ada{server_->port()};
  ada.send(
      "GET /operate HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Key: "
      "dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\nCookie: docent_login=odd\r\n\r\n");
  const auto [head, body] = ada.receive_reply();
  EXPECT_TRUE(head.starts_with("HTTP/1.1 503")) << head;
  EXPECT_NE(body.find("the database does not answer"), std::string::npos) << body;
}

TEST_F(HttpConnections, AnOperatorWhoHasLoggedInIsAdmitted) {
  start();
  server_->restrict_to(Stream::operators, 5);
  server_->broadcast(5, "for operators");
  server_->broadcast(6, "for all who watch");
  TestClient viewer{server_->port()};
  EXPECT_FALSE(viewer.upgrade("Cookie: docent_login=bad\r\n", "/operate"));
  TestClient other{server_->port()};
  EXPECT_FALSE(other.upgrade("Cookie: docent_login=good\r\nOrigin: http://evil.test\r\n", "/operate"));
  {
    TestClient ada{server_->port()};
    ASSERT_TRUE(ada.upgrade("Cookie: docent_login=good\r\n", "/operate"));
    EXPECT_EQ(ada.receive_frame().payload, "for operators");
    ada.send_frame(R"({"type":"steer","pressed":true,"forward":0.5,"turn":0})");
    ada.send_frame(R"({"type":"watch"})");
    for (int i = 0; i < 300; ++i) {
      const std::scoped_lock lock{mutex_};
      if (!heard_.empty()) break;
      std::this_thread::sleep_for(10ms);
    }
    const std::scoped_lock lock{mutex_};
    ASSERT_EQ(heard_.size(), 1U);
    EXPECT_EQ(heard_[0].first.name, "ada");
    EXPECT_EQ(heard_[0].first.role, Role::staff);
    EXPECT_TRUE(arrived_.empty()) << "no visitor";
  }
  EXPECT_EQ(left_.get_future().get(), "ada");
  // Who watches neither hears nor says what is an operator's.
  TestClient watching{server_->port()};
  ASSERT_TRUE(watching.upgrade());
  EXPECT_EQ(watching.receive_frame().payload, "for all who watch");
  watching.send_frame(R"({"type":"steer","pressed":true,"forward":0.5,"turn":0})");
  EXPECT_EQ(watching.receive_frame().close_code(), 1008);
}

TEST_F(HttpConnections, TheServerEndsWithCallsUnderWay) {
  desk_->delay = 200ms;
  start();
  std::vector<std::unique_ptr<TestClient>> clients;
  for (int i = 0; i < 20; ++i) {
    clients.push_back(std::make_unique<TestClient>(server_->port()));
    clients.back()->send("GET /api/v1/forum HTTP/1.1\r\nHost: localhost\r\n\r\n");
  }
  while (desk_->requests().size() < 10) std::this_thread::sleep_for(1ms);
  server_.reset();
}

}  // namespace
}  // namespace docent::telepresence
