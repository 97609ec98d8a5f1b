#include "docent/telepresence/accounts/logins.h"

#include <gtest/gtest.h>

#include "docent/telepresence/accounts/secrets.h"

namespace docent::telepresence {
namespace {

const Time kToday = time_from_seconds(100.0);

Login login_of(const std::string& token, Rank rank = Rank::operator_) {
  return {{"account:" + token, token, rank}, token, "csrf", "192.0.2.1", kToday + seconds(60.0)};
}

TEST(LoginsTest, KnowsThoseWithAccountsUntilTheirLoginIsOver) {
  Logins logins;
  logins.keep(login_of("ada"), kToday);
  logins.keep(login_of("visitor", Rank::visitor), kToday);
  ASSERT_TRUE(logins.find("ada", kToday));
  EXPECT_EQ(logins.find("ada", kToday)->person.name, "ada");
  EXPECT_FALSE(logins.find("visitor", kToday));
  EXPECT_FALSE(logins.find("", kToday));
  EXPECT_FALSE(logins.find("ada", kToday + seconds(60.0)));
  logins.end(login_of("ada"));
  EXPECT_FALSE(logins.find("ada", kToday));
}

TEST(LoginsTest, WhatTheDatabaseHasNoMoreIsOver) {
  Logins logins;
  logins.keep(login_of("ada"), kToday);
  logins.keep(login_of("grace"), kToday);
  logins.keep(login_of("new"), kToday + seconds(2.0));
  EXPECT_EQ(logins.learn({{hash_token("ada"), login_of("ada")}}, kToday + seconds(1.0)),
            std::vector<std::string>{hash_token("grace")});
  EXPECT_TRUE(logins.find("ada", kToday));
  EXPECT_FALSE(logins.find("grace", kToday));
  EXPECT_TRUE(logins.find("new", kToday)) << "began after the database was asked";
}

TEST(LoginsTest, WhatBeganAtAnotherGatewayIsKnownHere) {
  Logins logins;
  Login ada = login_of("ada");
  ada.token.clear();  // the database does not have it
  const auto live = [&](Rank rank) {
    ada.person.rank = rank;
    return std::map<std::string, Login>{{hash_token("ada"), ada}};
  };
  EXPECT_TRUE(logins.learn(live(Rank::visitor), kToday).empty());
  EXPECT_FALSE(logins.find("ada", kToday));
  EXPECT_TRUE(logins.learn(live(Rank::operator_), kToday).empty());
  ASSERT_TRUE(logins.find("ada", kToday));
  EXPECT_EQ(logins.find("ada", kToday)->token, "ada");
  EXPECT_FALSE(logins.find(hash_token("ada"), kToday)) << "the database's text opens nothing";
  logins.end(login_of("ada"));
  EXPECT_TRUE(logins.learn(live(Rank::operator_), kToday + seconds(1.0)).empty());
  EXPECT_FALSE(logins.find("ada", kToday)) << "it was ended here, and the database did not hear of it";
  EXPECT_TRUE(logins.learn({}, kToday + seconds(61.0)).empty());
}

}  // namespace
}  // namespace docent::telepresence
