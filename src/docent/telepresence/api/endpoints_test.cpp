#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <future>

#include "docent/telepresence/api/desk.h"

namespace docent::telepresence::endpoints_test {
namespace {

constexpr PasswordCost kCheap{1, 8U << 10U};
constexpr const char* kPassword = "a long way from Bonn";

std::string post_id(int number) { return "01900000-0000-7000-8000-00000000000" + std::to_string(number); }

/// Somebody with a browser.
struct Browser {
  std::string token, csrf;
};

class TheEndpoints : public testing::Test {
 protected:
  TheEndpoints() {
    std::filesystem::create_directories(folder_);
    ApiParams params;
    params.reads_per_second = params.writes_per_second = params.logins_per_minute = 1000.0;
    desk_ = std::move(*Desk::open(
        path_, params, {}, [] { return time_from_seconds(1.8e9); }, kCheap));
    auto services = std::move(*ApiServices::open(path_, {}, {}, kCheap));
    EXPECT_TRUE(services.accounts->add("ada", kPassword, Rank::operator_, {}));
  }
  ~TheEndpoints() override {
    desk_.reset();
    std::filesystem::remove_all(folder_);
  }
  ApiReply call(const Browser& from, const std::string& method, const std::string& path, const std::string& body = "") {
    ApiRequest request;
    request.method = method;
    request.target = "/api/v1" + path;
    request.body = body;
    request.token = from.token;
    request.csrf = from.csrf;
    request.address = "192.0.2.1";
    request.is_json = !body.empty();
    std::promise<ApiReply> promise;
    desk_->take(std::move(request), [&](ApiReply reply) { promise.set_value(std::move(reply)); });
    return promise.get_future().get();
  }
  static std::string reason(const ApiReply& reply) { return nlohmann::json::parse(reply.body).value("reason", ""); }
  Browser come(const std::string& path, const std::string& body, const Browser& as = {}) {
    const ApiReply reply = call(as, "POST", path, body);
    EXPECT_EQ(reply.status, 200) << reply.body;
    return {reply.set_cookie.substr(13, 64), nlohmann::json::parse(reply.body).at("csrf")};
  }
  std::string write(const Browser& author, int number) {
    const ApiReply reply =
        call(author, "POST", "/forum", R"({"id":")" + post_id(number) + R"(","title":"Hello","text":"all"})");
    return nlohmann::json::parse(reply.body).value(reply.status == 200 ? "state" : "reason", "");
  }
  void spoil(const std::string& statement) { ASSERT_TRUE((*Database::open(path_))->run(statement)); }

  const std::filesystem::path folder_ =
      std::filesystem::path{testing::TempDir()} / ("endpoints-" + std::to_string(::getpid()));
  const std::string path_ = folder_ / "web.sqlite";
  std::unique_ptr<Desk> desk_;
};

TEST_F(TheEndpoints, ANameThatLooksLikeAnAccountsIsTaken) {
  for (const char* name : {"ada", "ADA", "a d a", "\u0430da"})
    EXPECT_EQ(reason(call({}, "POST", "/visitor", R"({"name":")" + std::string{name} + R"("})")), "name_taken") << name;
  const Browser grace = come("/visitor", R"({"name":"grace"})");
  EXPECT_EQ(write(grace, 1), "held");
  auto services = std::move(*ApiServices::open(path_, {}, {}, kCheap));
  ASSERT_TRUE(services.accounts->add("grace", kPassword, Rank::moderator, {}));
  EXPECT_EQ(write(grace, 2), "name_taken") << "an account that came later";
}

TEST_F(TheEndpoints, WhoeverTakesAnotherNameIsReadBeforeItIsShown) {
  const Browser eve = come("/visitor", R"({"name":"Eve"})");
  ASSERT_EQ(write(eve, 1), "held");
  const Browser ada = come("/login", R"({"name":"ada","password":"a long way from Bonn"})");
  ASSERT_EQ(call(ada, "PUT", "/posts/" + post_id(1), R"({"state":"shown"})").status, 200);
  ASSERT_EQ(write(eve, 2), "shown");
  const Browser same = come("/visitor", R"({"name":"Eve"})", eve);
  ASSERT_EQ(write(same, 3), "shown");
  const Browser another = come("/visitor", R"({"name":"The director"})", same);
  EXPECT_EQ(write(another, 4), "held");
  EXPECT_EQ(write(ada, 5), "shown");
  const auto threads = nlohmann::json::parse(call({}, "GET", "/forum").body).at("threads");
  for (const auto& thread : threads) EXPECT_EQ(thread.at("rank"), thread.at("name") == "ada" ? "operator" : "visitor");
}

TEST_F(TheEndpoints, OnlyOperatorsAreToldWhyNothingIsStored) {
  const Browser ada = come("/login", R"({"name":"ada","password":"a long way from Bonn"})");
  spoil("DROP TABLE posts");
  const ApiReply strangers = call({}, "GET", "/forum");
  EXPECT_EQ(reason(strangers), "not_stored");
  EXPECT_EQ(nlohmann::json::parse(strangers.body).at("about"), "");
  EXPECT_NE(nlohmann::json::parse(call(ada, "GET", "/forum").body).at("about"), "");
}

}  // namespace
}  // namespace docent::telepresence::endpoints_test
