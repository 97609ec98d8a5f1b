#include "docent/telepresence/api/desk.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <future>

#include "docent/base/files.h"
#include "docent/base/shipped_files.h"
#include "docent/telepresence/accounts/secrets.h"

namespace docent::telepresence {
namespace {

constexpr PasswordCost kCheap{1, 8U << 10U};
constexpr const char* kPassword = "a long way from Bonn";
constexpr const char* kPost = "01900000-0000-7000-8000-000000000001";

ApiParams generous() {
  ApiParams params;
  params.reads_per_second = params.writes_per_second = 1000.0;
  params.logins_per_minute = 1000.0;
  return params;
}

/// Somebody with a browser: keeps the cookie and the token against other sites.
struct Browser {
  std::string token, csrf, address = "192.0.2.1";
};

class TheDesk : public testing::Test {
 protected:
  TheDesk() : path_{testing::TempDir() + "/desk-" + std::to_string(::getpid()) + ".sqlite"} {
    remove_files();
    open(generous());
    auto services = std::move(*ApiServices::open(path_, {}, {}, kCheap));
    EXPECT_TRUE(services.accounts->add("ada", kPassword, Rank::operator_, now_));
    EXPECT_TRUE(services.accounts->add("grace", kPassword, Rank::moderator, now_));
  }
  ~TheDesk() override { desk_.reset(), remove_files(); }
  void remove_files() const {
    for (const char* end : {"", "-wal", "-shm", ".accounts", ".lock"}) std::filesystem::remove(path_ + end);
  }
  void open(const ApiParams& params) {
    desk_.reset();
    desk_ = std::move(*Desk::open(
        path_, params, {}, [this] { return now_.load(); }, kCheap));
  }
  ApiReply call(ApiRequest request) {
    std::promise<ApiReply> promise;
    desk_->take(std::move(request), [&](ApiReply reply) { promise.set_value(std::move(reply)); });
    return promise.get_future().get();
  }
  static ApiRequest request(const Browser& from, const std::string& method, const std::string& path,
                            const std::string& body = "") {
    ApiRequest request;
    request.method = method;
    request.target = "/api/v1" + path;
    request.body = body;
    request.token = from.token;
    request.csrf = from.csrf;
    request.address = from.address;
    request.is_json = !body.empty();
    return request;
  }
  ApiReply call(const Browser& from, const std::string& method, const std::string& path, const std::string& body = "") {
    return call(request(from, method, path, body));
  }
  Browser logged_in(const std::string& path, const std::string& body) {
    const ApiReply reply = call({}, "POST", path, body);
    EXPECT_EQ(reply.status, 200) << reply.body;
    const auto me = nlohmann::json::parse(reply.body);
    return {reply.set_cookie.substr(13, 64), me.at("csrf"), "192.0.2.1"};
  }
  std::optional<std::string> admitted(const std::string& token) {
    std::promise<std::optional<Admission>> promise;
    desk_->admit(token, [&](Admitted who) { promise.set_value(who ? std::move(*who) : std::nullopt); });
    const auto who = promise.get_future().get();
    return who ? std::optional{who->name} : std::nullopt;
  }
  Browser operator_() { return logged_in("/login", R"({"name":"ada","password":"a long way from Bonn"})"); }
  Browser moderator() { return logged_in("/login", R"({"name":"grace","password":"a long way from Bonn"})"); }
  Browser visitor(const std::string& name = "Eve") { return logged_in("/visitor", R"({"name":")" + name + "\"}"); }
  static std::string reason(const ApiReply& reply) {
    return nlohmann::json::parse(reply.body).value("reason", std::string{});
  }
  static std::string post(const char* id = kPost, const std::string& text = "Hello") {
    return nlohmann::json{{"id", id}, {"title", "A title"}, {"text", text}}.dump();
  }

  const std::string path_;
  std::atomic<Time> now_{time_from_seconds(1'800'000'000)};
  std::unique_ptr<Desk> desk_;
};

TEST_F(TheDesk, ALoginBeginsAndEnds) {
  const ApiReply reply = call({}, "POST", "/login", R"({"name":"ada","password":"a long way from Bonn"})");
  EXPECT_EQ(reply.status, 200);
  EXPECT_TRUE(reply.set_cookie.starts_with("docent_login=")) << reply.set_cookie;
  for (const char* wanted : {"HttpOnly", "SameSite=Strict", "Path=/", "Max-Age=43200"})
    EXPECT_NE(reply.set_cookie.find(wanted), std::string::npos) << reply.set_cookie;
  Browser ada = operator_();
  EXPECT_EQ(nlohmann::json::parse(call(ada, "GET", "/login").body).at("rank"), "operator");
  EXPECT_EQ(call(ada, "GET", "/audit").status, 200);
  EXPECT_EQ(call(ada, "DELETE", "/login").status, 200);
  EXPECT_EQ(call(ada, "GET", "/audit").status, 403);
  EXPECT_EQ(nlohmann::json::parse(call(ada, "GET", "/login").body).at("rank"), "viewer");
  // A login ends by itself too.
  ada = operator_();
  now_ = now_.load() + std::chrono::hours{13};
  EXPECT_EQ(call(ada, "GET", "/audit").status, 403);
}

TEST_F(TheDesk, TellsNobodyWhetherANameHasAnAccount) {
  const ApiReply wrong = call({}, "POST", "/login", R"({"name":"ada","password":"wrong password"})");
  const ApiReply nobody = call({}, "POST", "/login", R"({"name":"nobody","password":"wrong password"})");
  EXPECT_EQ(wrong.status, 401);
  EXPECT_EQ(wrong.body, nobody.body);
  EXPECT_EQ(wrong.set_cookie, "");
}

// Every verb of the table against every rank.
TEST_F(TheDesk, LetsEachRankDoWhatTheTableSaysAndNothingMore) {
  const std::map<Rank, Browser> browsers{
      {Rank::viewer, {}}, {Rank::visitor, visitor()}, {Rank::moderator, moderator()}, {Rank::operator_, operator_()}};
  int allowed = 0, refused = 0;
  for (const Endpoint& endpoint : endpoints()) {
    if (std::string_view{endpoint.name} == "logout") continue;  // it would end the login that is tried next
    for (const auto& [rank, browser] : browsers) {
      std::string path = endpoint.path;
      for (std::size_t at = 0; (at = path.find('{')) != std::string::npos;)
        path.replace(at, path.find('}') - at + 1, "none-such");
      const ApiReply reply = call(browser, endpoint.method, path, endpoint.has_body ? "{}" : "");
      const bool may = rank >= endpoint.least;
      EXPECT_EQ(reason(reply) == "not_allowed", !may) << endpoint.name << " by a " << to_text(rank) << reply.body;
      (may ? allowed : refused) += 1;
      if (!may) continue;
      // Nor another site that has the cookie sent, nor anybody who has only the cookie.
      ApiRequest forged = request(browser, endpoint.method, path, endpoint.has_body ? "{}" : "");
      forged.is_of_ours = false;
      EXPECT_EQ(reason(call(forged)), "other_site") << endpoint.name;
      if (!endpoint.changes() || rank == Rank::viewer) continue;
      forged.is_of_ours = true, forged.csrf = "";
      EXPECT_EQ(reason(call(forged)), "wrong_csrf") << endpoint.name;
      forged.csrf = browsers.at(rank == Rank::visitor ? Rank::moderator : Rank::visitor).csrf;
      EXPECT_EQ(reason(call(forged)), "wrong_csrf") << endpoint.name;
    }
  }
  EXPECT_GT(allowed, 30);
  EXPECT_GT(refused, 15);
}

TEST_F(TheDesk, AVisitorWritesAModeratorShowsAndEverybodyReads) {
  const Browser eve = visitor(), grace = moderator();
  const ApiReply written = call(eve, "POST", "/forum", post());
  EXPECT_EQ(written.body, R"({"state":"held"})");
  EXPECT_EQ(call(eve, "POST", "/forum", post()).body, R"({"state":"held"})") << "sent again: once";
  const std::string at = std::string{"/forum/"} + kPost;
  EXPECT_EQ(nlohmann::json::parse(call({}, "GET", at).body).at("posts").size(), 0U);
  EXPECT_EQ(nlohmann::json::parse(call(eve, "GET", at).body).at("posts").at(0).at("is_own"), true);
  const auto queue = nlohmann::json::parse(call(grace, "GET", "/moderation").body).at("posts");
  ASSERT_EQ(queue.size(), 1U);
  EXPECT_EQ(queue[0].at("name"), "Eve");
  EXPECT_EQ(call(grace, "PUT", std::string{"/posts/"} + kPost, R"({"state":"shown"})").status, 200);
  EXPECT_EQ(nlohmann::json::parse(call({}, "GET", at).body).at("posts").at(0).at("text"), "Hello");
  const auto threads = nlohmann::json::parse(call({}, "GET", "/forum").body);
  EXPECT_EQ(threads.at("threads").at(0).at("title"), "A title");
  EXPECT_EQ(call({}, "GET", "/forum?before=1").body, R"({"is_last":true,"threads":[]})");
  EXPECT_EQ(call({}, "GET", "/forum?before=x").status, 400);
  EXPECT_EQ(call({}, "GET", "/forum?limit=100000").status, 400);
}

TEST_F(TheDesk, SendsAwayWhoMisbehavesAndKeepsALog) {
  const Browser eve = visitor(), grace = moderator(), ada = operator_();
  ASSERT_EQ(call(eve, "POST", "/forum", post()).status, 200);
  const std::string path = std::string{"/posts/"} + kPost;
  now_ = now_.load() + seconds(1.0);
  EXPECT_EQ(call(grace, "POST", path + "/send_away").status, 200);
  EXPECT_EQ(reason(call(eve, "POST", "/forum", post())), "not_allowed");
  EXPECT_EQ(reason(call({}, "POST", "/visitor", R"({"name":"Eve"})")), "sent_away") << "from the same address";
  const auto line = nlohmann::json::parse(call(ada, "GET", "/audit").body).at("lines").at(0);
  EXPECT_EQ(line.at("what"), "send_away");
  EXPECT_EQ(line.at("who").get<std::string>() + " " + line.at("address").get<std::string>(), "account:grace 192.0.2.1");
  EXPECT_EQ(line.at("about"), kPost);
  // Nobody sends away those who have accounts.
  constexpr const char* kOther = "01900000-0000-7000-8000-000000000002";
  ASSERT_EQ(call(ada, "POST", "/forum", post(kOther)).status, 200);
  EXPECT_EQ(reason(call(grace, "POST", std::string{"/posts/"} + kOther + "/send_away")), "not_allowed");
}

TEST_F(TheDesk, RefusesWhatItDoesNotUnderstand) {
  const Browser eve = visitor();
  EXPECT_EQ(reason(call(eve, "POST", "/forum", "{")), "not_understood");
  EXPECT_EQ(reason(call(eve, "POST", "/forum", post("1"))), "not_understood");
  EXPECT_EQ(reason(call(eve, "POST", "/forum", post(kPost, " \n "))), "nothing_said");
  EXPECT_EQ(reason(call(eve, "POST", "/forum/no-such", post())), "not_found");
  EXPECT_EQ(reason(call(eve, "GET", "/forum", "{}")), "not_understood");
  ApiRequest form = request(eve, "POST", "/forum", post());
  form.is_json = false;
  EXPECT_EQ(reason(call(form)), "not_understood") << "as a page of another site could send it without asking";
  EXPECT_EQ(reason(call(eve, "PATCH", "/forum")), "wrong_method");
  EXPECT_EQ(reason(call(eve, "GET", "/nowhere")), "not_found");
}

TEST_F(TheDesk, InjectionsStayText) {
  const std::string nasty = R"(</script><img src=x onerror=alert(1)>'; DROP TABLE posts; --)";
  const Browser eve = visitor("'; DELETE FROM accounts; --");
  ASSERT_EQ(call(eve, "POST", "/forum", post(kPost, nasty)).status, 200);
  EXPECT_EQ(call({}, "POST", "/login", nlohmann::json{{"name", "ada' --"}, {"password", kPassword}}.dump()).status,
            401);
  const auto posts = nlohmann::json::parse(call(moderator(), "GET", "/moderation").body).at("posts");
  EXPECT_EQ(posts.at(0).at("text"), nasty);
  EXPECT_EQ(posts.at(0).at("name"), "'; DELETE FROM accounts; --");
}

TEST_F(TheDesk, SlowsDownWhoGuessesPasswords) {
  ApiParams params = generous();
  params.logins_per_minute = 3.0;
  open(params);
  const auto guess = [&](const std::string& name, const std::string& address) {
    Browser from;
    from.address = address;
    return call(from, "POST", "/login", R"({"name":")" + name + R"(","password":"wrong password"})").status;
  };
  for (int i = 0; i < 3; ++i) EXPECT_EQ(guess("x" + std::to_string(i), "192.0.2.66"), 401);
  EXPECT_EQ(guess("x9", "192.0.2.66"), 429) << "one address";
  for (int i = 0; i < 10; ++i) EXPECT_EQ(guess("ada", "198.51.100." + std::to_string(i)), 401);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(guess("ada", "198.51.100." + std::to_string(i)), 401);
  EXPECT_EQ(guess("ada", "198.51.100.9"), 429) << "one name, by many who have guessed before";
  EXPECT_EQ(call({}, "POST", "/login", R"({"name":"ada","password":"a long way from Bonn"})").status, 200)
      << "but whoever has not guessed gets in";
  now_ = now_.load() + std::chrono::seconds{61};
  EXPECT_EQ(guess("ada", "198.51.100.9"), 401);
}

TEST_F(TheDesk, AnOperatorWaitsBehindNoVisitor) {
  ApiParams params = generous();
  params.calls_waiting = 2;
  open(params);
  const Browser ada = operator_();
  // The database is held by another program: whoever wants to write in the forum waits for it.
  const Browser eve = visitor();
  const auto other = std::move(*Database::open(path_));
  ASSERT_TRUE(other->run_script("BEGIN EXCLUSIVE"));
  std::atomic<int> answered = 0;
  for (int i = 0; i < 20; ++i)
    desk_->take(request(eve, "POST", "/forum", post()), [&](const ApiReply&) { ++answered; });
  EXPECT_EQ(call(ada, "GET", "/login").status, 200);
  EXPECT_EQ(admitted(ada.token), "ada");
  EXPECT_LT(answered, 20) << "they still wait";
  ASSERT_TRUE(other->run_script("ROLLBACK"));
  desk_.reset();
  EXPECT_EQ(answered, 20);
}

TEST_F(TheDesk, TellsWhichLoginIsOverAtOnceOrWhenAnotherProgramEndedIt) {
  std::promise<std::string> first, second;
  std::atomic<int> ended = 0;
  desk_->when_ended([&](const std::string& login) { (++ended == 1 ? first : second).set_value(login); });
  const Browser ada = operator_();
  EXPECT_EQ(call(ada, "DELETE", "/login").status, 200);
  EXPECT_EQ(ended, 1) << "before it is answered";
  EXPECT_EQ(first.get_future().get(), hash_token(ada.token));
  EXPECT_EQ(admitted(ada.token), std::nullopt);
  const Browser again = operator_();
  now_ = now_.load() + std::chrono::seconds{1};
  desk_->look();
  EXPECT_EQ(call(again, "GET", "/audit").status, 200) << "behind the look";
  EXPECT_EQ(ended, 1) << "this one goes on";
  auto services = std::move(*ApiServices::open(path_, {}, {}, kCheap));
  ASSERT_TRUE(services.accounts->set_password("ada", "another long password"));
  desk_->look();
  EXPECT_EQ(second.get_future().get(), hash_token(again.token)) << "as `docent web-account` does it";
  EXPECT_EQ(admitted(again.token), std::nullopt);
  EXPECT_EQ(call(again, "GET", "/audit").status, 403);
  desk_->when_ended({});
}

TEST_F(TheDesk, WhatOperatorsDoDoesNotComeThroughAGatewayFarAway) {
  const Browser ada = operator_();
  const auto far = [&](const std::string& method, const std::string& path, const std::string& body = "") {
    ApiRequest call_from_far = request(ada, method, path, body);
    call_from_far.is_far = true;
    return call(call_from_far).status;
  };
  EXPECT_EQ(far("GET", "/forum"), 200);
  EXPECT_EQ(far("POST", "/forum", post()), 403) << "a login with an account is none there";
  EXPECT_EQ(far("GET", "/audit"), 403);
  EXPECT_EQ(far("GET", "/moderation"), 403);
  EXPECT_EQ(far("POST", "/login", R"({"name":"ada","password":"a long way from Bonn"})"), 403);
}

TEST_F(TheDesk, HoldsOutInAFlood) {
  ApiParams params;
  params.reads_per_second = params.writes_per_second = 1.0;
  params.calls_waiting = 4;
  open(params);
  int answered = 0, too_fast = 0;
  for (int i = 0; i < 200; ++i) (call({}, "GET", "/forum").status == 429 ? too_fast : answered) += 1;
  EXPECT_EQ(answered, 10) << "the burst";
  EXPECT_EQ(too_fast, 190);
  Browser other;
  other.address = "198.51.100.1";
  EXPECT_EQ(call(other, "GET", "/forum").status, 200) << "others are still served";
  // Many at once from many places: each is answered, some that the desk is busy.
  std::atomic<int> all{0};
  for (int i = 0; i < 500; ++i) {
    other.address = "203.0.113." + std::to_string(i);
    desk_->take(request(other, "GET", "/forum"), [&](const ApiReply& reply) {
      EXPECT_TRUE(reply.status == 200 || reply.status == 503);
      ++all;
    });
  }
  desk_.reset();
  EXPECT_EQ(all, 500);
}

TEST_F(TheDesk, AdmitsOperatorsAlone) {
  EXPECT_EQ(admitted(operator_().token), "ada");
  EXPECT_EQ(admitted(moderator().token), std::nullopt);
  EXPECT_EQ(admitted(visitor().token), std::nullopt);
  EXPECT_EQ(admitted(""), std::nullopt);
}

/// A desk in whose office lies a copy of the museum of Bonn.
class TheMuseumDesk : public TheDesk {
 protected:
  TheMuseumDesk() {
    std::filesystem::create_directories(root_);
    std::filesystem::copy(shipped_path("museums/bonn"), root_ / "bonn", std::filesystem::copy_options::recursive);
    MuseumOffice office{{root_ / "bonn", root_ / "trial", {}},
                        [this] { return is_stopped_.load(); },
                        [this](bool into_trial) { moves_.push_back(into_trial); }};
    desk_.reset();
    desk_ = std::move(*Desk::open(
        path_, generous(), {}, [this] { return now_.load(); }, kCheap,
        std::make_shared<const MuseumOffice>(std::move(office))));
    ada_ = operator_();
  }
  ~TheMuseumDesk() override {
    desk_.reset();
    std::filesystem::remove_all(root_);
  }
  /// The museum as it is, with a hazard round (x, y).
  nlohmann::json wish(double x, double y) {
    auto edition = nlohmann::json::parse(call(ada_, "GET", "/museum").body);
    edition["draft"]["hazards"].push_back(
        {{"id", "puddle"}, {"kind", "other"}, {"polygon", {{x, y}, {x + 1.0, y}, {x + 1.0, y + 1.0}, {x, y + 1.0}}}});
    return {{"revision", edition["revision"]}, {"draft", edition["draft"]}};
  }
  [[nodiscard]] std::string published() const { return *read_file(root_ / "bonn" / "museum.yaml"); }

  const std::filesystem::path root_ = testing::TempDir() + "/desk-museum-" + std::to_string(::getpid());
  std::atomic<bool> is_stopped_ = true;
  std::vector<bool> moves_;
  Browser ada_;
};

TEST_F(TheMuseumDesk, TriesAndPublishesWhatCanWork) {
  const std::string wish_text = wish(9.0, 7.0).dump();
  ApiReply reply = call(ada_, "PUT", "/museum/trial", wish_text);
  EXPECT_EQ(reply.status, 200) << reply.body;
  EXPECT_EQ(reply.body, R"({"faults":[]})");
  EXPECT_EQ(published().find("puddle"), std::string::npos);
  reply = call(ada_, "PUT", "/museum", wish_text);
  EXPECT_EQ(reply.body, R"({"faults":[]})");
  EXPECT_NE(published().find("puddle"), std::string::npos);
  EXPECT_EQ(reason(call(ada_, "PUT", "/museum", wish_text)), "outdated");
  EXPECT_EQ(call(ada_, "DELETE", "/museum/trial").status, 200);
  EXPECT_EQ(moves_, (std::vector{true, false, false}));
}

TEST_F(TheMuseumDesk, ChangesNothingUnderARobotThatMayDrive) {
  const auto wanted = wish(9.0, 7.0);
  const std::string before = published();
  is_stopped_ = false;
  for (const char* path : {"/museum", "/museum/trial"}) {
    const ApiReply reply = call(ada_, "PUT", path, wanted.dump());
    EXPECT_EQ(reply.status, 409);
    EXPECT_EQ(reason(reply), "must_stand");
  }
  EXPECT_EQ(reason(call(ada_, "DELETE", "/museum/trial")), "must_stand");
  EXPECT_EQ(call(ada_, "POST", "/museum/check", wanted["draft"].dump()).status, 200) << "to look needs no stop";
  EXPECT_EQ(published(), before);
  EXPECT_TRUE(moves_.empty());
}

TEST_F(TheMuseumDesk, NamesWhatCannotWork) {
  const auto wanted = wish(8.5, 3.1);  // round where it waits
  for (const ApiReply& reply :
       {call(ada_, "POST", "/museum/check", wanted["draft"].dump()), call(ada_, "PUT", "/museum/trial", wanted.dump()),
        call(ada_, "PUT", "/museum", wanted.dump())})
    EXPECT_NE(reply.body.find("home lies inside the hazard 'puddle'"), std::string::npos) << reply.body;
  auto strange = wish(9.0, 7.0);
  strange["draft"]["hazards"][0]["id"] = "../../a}, kind: glass";
  EXPECT_NE(call(ada_, "PUT", "/museum", strange.dump()).body, R"({"faults":[]})");
  EXPECT_TRUE(moves_.empty());
}

TEST_F(TheMuseumDesk, SetsUpNothingWhereNothingIsSetUp) {
  const ApiReply reply = call(ada_, "GET", "/setup");
  EXPECT_EQ(reply.status, 404);
  EXPECT_EQ(reason(call(ada_, "PUT", "/setup/step", R"({"step":"tour"})")), "not_found");
}

/// A desk in whose office a museum is set up.
class TheSetupDesk : public TheDesk {
 protected:
  TheSetupDesk() {
    EXPECT_TRUE(museum::MuseumSetup::begin(root_ / "hall", {}));
    SetupOffice office{root_ / "hall",
                       {root_ / "hall", root_ / "state", {}},
                       [this](ExplorationOrder order) { orders_.push_back(order); },
                       [this] { ++moves_; }};
    desk_.reset();
    desk_ = std::move(*Desk::open(
        path_, generous(), {}, [this] { return now_.load(); }, kCheap, nullptr,
        std::make_shared<const SetupOffice>(std::move(office))));
    ada_ = operator_();
  }
  ~TheSetupDesk() override {
    desk_.reset();
    std::filesystem::remove_all(root_);
  }

  const std::filesystem::path root_ = testing::TempDir() + "/desk-setup-" + std::to_string(::getpid());
  std::vector<ExplorationOrder> orders_;
  int moves_ = 0;
  Browser ada_;
};

TEST_F(TheSetupDesk, LeadsOperatorsThroughTheSteps) {
  EXPECT_EQ(nlohmann::json::parse(call(ada_, "GET", "/setup").body)["step"], "name");
  EXPECT_EQ(call(visitor(), "GET", "/setup").status, 403) << "nobody else";
  EXPECT_NE(call(ada_, "PUT", "/setup/name", R"({"name":"","languages":["en"]})").body, R"({"faults":[]})");
  EXPECT_EQ(moves_, 0);
  EXPECT_EQ(call(ada_, "PUT", "/setup/name", R"({"name":"Hall","languages":["en"]})").body, R"({"faults":[]})");
  EXPECT_EQ(moves_, 1) << "the museum has another name";
  EXPECT_EQ(call(ada_, "PUT", "/setup/order", R"({"order":"by_itself"})").status, 200);
  EXPECT_EQ(orders_, std::vector{ExplorationOrder::by_itself});
  EXPECT_EQ(reason(call(ada_, "PUT", "/setup/order", R"({"order":"dance"})")), "not_understood");
  EXPECT_NE(call(ada_, "PUT", "/setup/map").body, R"({"faults":[]})") << "there is no map";
  EXPECT_NE(call(ada_, "PUT", "/setup/step", R"({"step":"tour"})").body, R"({"faults":[]})");
  EXPECT_EQ(moves_, 1);
}

}  // namespace
}  // namespace docent::telepresence
