#include "docent/telepresence/api/audit.h"

#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <set>
#include <string>

#include "docent/telepresence/api/endpoint.h"
#include "docent/telepresence/store/postgres_fixture.h"

// The same for a file and for a server.

namespace docent::telepresence {
namespace {

class TheAuditLog : public testing::TestWithParam<bool> {
 protected:
  static void SetUpTestSuite() { postgres = std::make_unique<Postgres>(); }
  static void TearDownTestSuite() { postgres.reset(); }
  void SetUp() override {
    if (GetParam() && !postgres->is_installed()) GTEST_SKIP() << "skipped: no PostgreSQL is installed";
    database_ = std::move(*Database::open(GetParam() ? postgres->address() : ":memory:"));
    if (GetParam()) {
      ASSERT_TRUE(database_->run_script("DROP SCHEMA public CASCADE; CREATE SCHEMA public"));
    }
    audit_ = std::move(*Audit::open(*database_));
  }
  void add(int at, const std::string& who = "account:ada", const std::string& address = "192.0.2.1") const {
    ASSERT_TRUE(audit_->add({time_from_seconds(at), who, "login", std::to_string(at), address}));
  }
  [[nodiscard]] std::string found(const AuditSearch& search) const {
    const auto entries = audit_->find(search);
    EXPECT_TRUE(entries) << entries.error().message;
    std::string text;
    for (const AuditEntry& entry : *entries) text += entry.about + " ";
    return text;
  }
  static std::unique_ptr<Postgres> postgres;
  std::unique_ptr<Database> database_;
  std::unique_ptr<Audit> audit_;
};
std::unique_ptr<Postgres> TheAuditLog::postgres;

TEST_P(TheAuditLog, GivesPagesFromTheNewestToTheOldestEachEntryOnce) {
  for (int i = 0; i < 7; ++i) add(i / 2);  // two at the same time each
  AuditSearch search;
  search.most = 3;
  int seen = 0;
  double last = 10.0;
  std::set<std::string> places;
  while (true) {
    const auto page = *audit_->find(search);
    if (page.empty()) break;
    for (const AuditEntry& entry : page) {
      ++seen;
      places.insert(entry.place);
      EXPECT_LE(to_seconds(entry.time), last);
      last = to_seconds(entry.time);
    }
    search.before = page.back().place;
    ASSERT_TRUE(Audit::is_place(search.before));
  }
  EXPECT_EQ(seen, 7);
  EXPECT_EQ(places.size(), 7U);
}

TEST_P(TheAuditLog, IsSearchedByAccountAddressAndTime) {
  add(1);
  add(2, "account:grace", "192.0.2.7");
  add(3, "ada", "198.51.100.1");  // a wrong password
  add(4, "v-1", "2001:db8::1");
  EXPECT_EQ(found({.account = "ada"}), "3 1 ");
  EXPECT_EQ(found({.account = "account:grace"}), "2 ");
  EXPECT_EQ(found({.address = "192.0.2."}), "2 1 ");
  EXPECT_EQ(found({.address = "192.0.2.1"}), "1 ");
  EXPECT_EQ(found({.address = "%"}), "") << "nothing stands for anything";
  EXPECT_EQ(found({.from = time_from_seconds(2), .until = time_from_seconds(4)}), "3 2 ");
  EXPECT_EQ(found({.account = "ada", .address = "192.0.2.1", .until = time_from_seconds(9)}), "1 ");
  EXPECT_FALSE(Audit::is_place("nonsense"));
  EXPECT_FALSE(Audit::is_place("12"));
}

TEST_P(TheAuditLog, CountsWrongPasswordsTogether) {
  const auto wrong = [&](int at, const std::string& who, const std::string& address) {
    ASSERT_TRUE(audit_->count({time_from_seconds(at), who, "wrong_password", "", address}));
  };
  for (int i = 0; i < 500; ++i) wrong(i, "ada", "192.0.2.1");
  wrong(10, "ada", "192.0.2.2");
  wrong(3600, "ada", "192.0.2.1");
  const auto all = *audit_->find({});
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[0].count, 1);
  EXPECT_EQ(all[1].count, 500);
  EXPECT_EQ(all[1].time, time_from_seconds(499)) << "the last one";
  EXPECT_EQ(all[2].count, 1);
}

TEST_P(TheAuditLog, ForgetsWhatIsOlderThanNinetyDays) {
  constexpr int kDay = 86400;
  add(0);
  add(kDay);
  audit_->forget(time_from_seconds(90 * kDay));
  EXPECT_EQ(found({}), "86400 0 ");
  audit_->forget(time_from_seconds(90 * kDay + 1));
  EXPECT_EQ(found({}), "86400 ");
}

/// What an operator gets of /api/v1, and what strangers leave there.
class TheAuditLogOnTheWeb : public testing::Test {
 protected:
  TheAuditLogOnTheWeb() { EXPECT_TRUE(services_.accounts->add("ada", "a long way from Bonn", Rank::operator_, kNow)); }
  ApiAnswer<nlohmann::json> call(const std::string& method, const std::string& target,
                                 const nlohmann::json& body = nlohmann::json::object()) {
    ApiRequest request;
    request.address = "192.0.2.1";
    std::map<std::string, std::string> path;
    const auto endpoint = find_endpoint(endpoints(), method, "/api/v1" + target, path);
    if (!endpoint) return tl::unexpected<ApiRefusal>(endpoint.error());
    ApiCall one{services_, request, {}, {}, path, *parse_query(target), kNow, {}, {}, {}};
    return (*endpoint)->handle(one, body);
  }
  void log_in(const std::string& name, const std::string& password) {
    (void)call("POST", "/login", {{"name", name}, {"password", password}});
  }
  [[nodiscard]] std::size_t found(const std::string& query) {
    return call("GET", "/audit?" + query).value().at("lines").size();
  }
  const Time kNow = time_from_seconds(1'800'000'000);
  ApiServices services_ = std::move(*ApiServices::open(":memory:", {}, {}, {1, 8U << 10U}));
};

TEST_F(TheAuditLogOnTheWeb, IsNotBuriedByWrongPasswords) {
  log_in("ada", "a long way from Bonn");
  for (int i = 0; i < 40; ++i) log_in("ada", "wrong password");
  for (int i = 0; i < 40; ++i) log_in("guess" + std::to_string(i), "wrong password");
  const auto lines = call("GET", "/audit").value().at("lines");
  ASSERT_EQ(lines.size(), 3U) << lines.dump();
  std::map<std::string, std::int64_t> counts;
  for (const auto& line : lines) counts[line.at("who")] = line.at("count").get<std::int64_t>();
  EXPECT_EQ(counts["ada"], 40);
  EXPECT_EQ(counts["no account"], 40);
  EXPECT_EQ(counts["account:ada"], 1);
}

TEST_F(TheAuditLogOnTheWeb, IsReadInPagesAndSearched) {
  for (int i = 0; i < 250; ++i)
    ASSERT_TRUE(services_.audit->add({kNow, "account:ada", "login", std::to_string(i), "192.0.2.7"}));
  std::set<std::string> seen;
  std::string query;
  for (int page = 0; page < 3; ++page) {
    const auto answer = call("GET", "/audit?" + query).value();
    for (const auto& line : answer.at("lines")) seen.insert(line.at("about"));
    EXPECT_EQ(answer.at("next").get<std::string>().empty(), page == 2);
    query = "before=" + answer.at("next").get<std::string>();
  }
  EXPECT_EQ(seen.size(), 250U);
  EXPECT_EQ(found("account=ada&address=192.0.2.7"), 100U);
  EXPECT_EQ(found("account=grace"), 0U);
  EXPECT_EQ(found("address=192.0.2.1"), 0U);
  EXPECT_EQ(found("from=1&until=2"), 0U);
  EXPECT_EQ(call("GET", "/audit?from=yesterday").error().reason, ApiFault::not_understood);
  EXPECT_EQ(call("GET", "/audit?before=nonsense").error().reason, ApiFault::not_understood);
}

INSTANTIATE_TEST_SUITE_P(Both, TheAuditLog, testing::Bool(),
                         [](const auto& kind) { return kind.param ? "server" : "file"; });

}  // namespace
}  // namespace docent::telepresence
