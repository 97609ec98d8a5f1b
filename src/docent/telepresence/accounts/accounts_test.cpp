#include "docent/telepresence/accounts/accounts.h"

#include <gtest/gtest.h>

#include "docent/telepresence/store/postgres_fixture.h"

namespace docent::telepresence {
namespace {

constexpr PasswordCost kCheap{1, 8U << 10U};
const Time kNow = time_from_seconds(1'000'000);
constexpr double kHour = 3600.0;
constexpr const char* kPassword = "a long way from Bonn";

class TheAccounts : public testing::Test {
 protected:
  void SetUp() override {
    database_ = std::move(*Database::open(":memory:"));
    accounts_ = std::move(*Accounts::open(*database_, kCheap));
    ASSERT_TRUE(accounts_->add("ada", kPassword, Rank::operator_, kNow));
    ASSERT_TRUE(accounts_->add("grace", "another password", Rank::moderator, kNow));
  }
  [[nodiscard]] std::optional<Login> found(const std::string& token, Time now = kNow) const {
    auto login = accounts_->find(token, now);
    EXPECT_TRUE(login) << login.error().message;
    return *login;
  }
  [[nodiscard]] Login begun(const Person& person, const std::string& address = "192.0.2.1") const {
    auto login = accounts_->begin(person, address, kHour, kNow);
    EXPECT_TRUE(login) << login.error().message;
    return *login;
  }
  std::unique_ptr<Database> database_;
  std::unique_ptr<Accounts> accounts_;
};

TEST_F(TheAccounts, KnowTheirPasswords) {
  const auto ada = *accounts_->check("ada", kPassword);
  ASSERT_TRUE(ada);
  EXPECT_EQ(ada->id, "account:ada");
  EXPECT_EQ(ada->rank, Rank::operator_);
  EXPECT_FALSE(*accounts_->check("ada", "another password"));
  EXPECT_FALSE(*accounts_->check("ada", ""));
  EXPECT_FALSE(*accounts_->check("nobody", kPassword));
  EXPECT_FALSE(*accounts_->check("ada' OR '1'='1", kPassword));
}

TEST_F(TheAccounts, AreAddedOnceAndOnlyInOrder) {
  EXPECT_EQ(accounts_->add("ada", kPassword, Rank::moderator, kNow).error().message,
            "there is an account 'ada' already");
  EXPECT_FALSE(accounts_->add("Ada Lovelace", kPassword, Rank::moderator, kNow));
  EXPECT_FALSE(accounts_->add("eve", "short", Rank::moderator, kNow));
  EXPECT_FALSE(accounts_->add("eve", std::string(201, 'x'), Rank::moderator, kNow));
  EXPECT_FALSE(accounts_->add("eve", kPassword, Rank::visitor, kNow)) << "visitors have no accounts";
  const auto list = *accounts_->list();
  ASSERT_EQ(list.size(), 2U);
  EXPECT_EQ(list[0].name, "ada");
  EXPECT_EQ(list[1].rank, Rank::moderator);
}

TEST_F(TheAccounts, ALoginIsFoundByItsTokenUntilItEnds) {
  const Login login = begun(**accounts_->check("ada", kPassword));
  const auto again = found(login.token);
  ASSERT_TRUE(again);
  EXPECT_EQ(again->person.name, "ada");
  EXPECT_EQ(again->csrf, login.csrf);
  EXPECT_FALSE(found(hash_token(login.token))) << "what is stored is no token";
  EXPECT_FALSE(found(""));
  EXPECT_FALSE(found(login.token, kNow + seconds(kHour + 1)));
  ASSERT_TRUE(accounts_->end(login.token));
  EXPECT_FALSE(found(login.token));
}

TEST_F(TheAccounts, ANewPasswordOrNoAccountEndsLogins) {
  const Login ada = begun(**accounts_->check("ada", kPassword));
  ASSERT_TRUE(accounts_->set_password("ada", "something else entirely"));
  EXPECT_FALSE(found(ada.token));
  EXPECT_FALSE(*accounts_->check("ada", kPassword));
  const Login again = begun(**accounts_->check("ada", "something else entirely"));
  ASSERT_TRUE(accounts_->remove("ada"));
  EXPECT_FALSE(found(again.token));
  EXPECT_FALSE(accounts_->remove("ada"));
  EXPECT_FALSE(accounts_->set_password("ada", kPassword));
}

TEST_F(TheAccounts, WhoIsSentAwayStaysAwayForAWhile) {
  const Login eve = begun({"v-eve", "Eve", Rank::visitor}, "198.51.100.7");
  const Login bob = begun({"v-bob", "Bob", Rank::visitor}, "192.0.2.9");
  ASSERT_TRUE(accounts_->send_away("v-eve", kNow + seconds(kHour), kNow));
  EXPECT_FALSE(found(eve.token));
  EXPECT_TRUE(found(bob.token));
  EXPECT_TRUE(*accounts_->is_sent_away("198.51.100.7", kNow));
  EXPECT_FALSE(*accounts_->is_sent_away("192.0.2.9", kNow));
  EXPECT_FALSE(*accounts_->is_sent_away("", kNow + seconds(kHour + 1)));
  EXPECT_FALSE(*accounts_->is_sent_away("198.51.100.7", kNow + seconds(kHour + 1)));
  // Nor does a login of theirs that was begun elsewhere hold.
  EXPECT_FALSE(found(begun({"v-eve", "Eve", Rank::visitor}, "203.0.113.1").token));
}

TEST(SharedAccounts, ALoginThatOneGatewayBeganIsFoundByTheOther) {
  const Postgres server;
  if (!server.is_installed()) GTEST_SKIP() << "no PostgreSQL here";
  ASSERT_TRUE(server.is_running());
  auto one = std::move(*Database::open(server.address()));
  auto other = std::move(*Database::open(server.address()));
  auto here = std::move(*Accounts::open(*one, kCheap));
  auto there = std::move(*Accounts::open(*other, kCheap));
  ASSERT_TRUE(here->add("ada", kPassword, Rank::operator_, kNow));
  const auto login = *here->begin(**there->check("ada", kPassword), "192.0.2.1", kHour, kNow);
  EXPECT_TRUE(*there->find(login.token, kNow));
  ASSERT_TRUE(there->send_away("account:ada", kNow + seconds(1), kNow));
  EXPECT_FALSE(*here->find(login.token, kNow));
}

}  // namespace
}  // namespace docent::telepresence
