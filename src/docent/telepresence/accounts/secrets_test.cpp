#include "docent/telepresence/accounts/secrets.h"

#include <gtest/gtest.h>

#include <set>

namespace docent::telepresence {
namespace {

TEST(Secrets, APasswordIsKnownAgainAndItsHashIsNeverTheSame) {
  const auto hash = hash_password("a long way from Bonn", {1, 8U << 20U});
  ASSERT_TRUE(hash) << hash.error().message;
  EXPECT_TRUE(hash->starts_with("$argon2id$")) << *hash;
  EXPECT_TRUE(is_password("a long way from Bonn", *hash));
  EXPECT_FALSE(is_password("a long way from bonn", *hash));
  EXPECT_FALSE(is_password("", *hash));
  EXPECT_NE(*hash, *hash_password("a long way from Bonn", {1, 8U << 20U}));
}

TEST(Secrets, WhatIsNoHashFitsNoPassword) {
  for (const std::string& hash : {std::string{}, std::string{"x"}, std::string(500, 'a'), std::string{"$argon2id$"}})
    EXPECT_FALSE(is_password("x", hash)) << hash;
}

TEST(Secrets, TokensDifferAndAreStoredUnderAnotherText) {
  std::set<std::string> seen;
  for (int i = 0; i < 100; ++i) {
    const std::string token = make_token();
    EXPECT_EQ(token.size(), 64U);
    EXPECT_TRUE(seen.insert(token).second);
    EXPECT_TRUE(seen.insert(hash_token(token)).second);
    EXPECT_EQ(hash_token(token), hash_token(token));
  }
  EXPECT_TRUE(is_same_secret("abc", "abc"));
  EXPECT_FALSE(is_same_secret("abc", "abd"));
  EXPECT_FALSE(is_same_secret("abc", "ab"));
}

}  // namespace
}  // namespace docent::telepresence
