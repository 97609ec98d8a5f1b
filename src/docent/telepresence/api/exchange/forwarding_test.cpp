#include "docent/telepresence/api/exchange/forwarding.h"

#include <gtest/gtest.h>

namespace docent::telepresence {
namespace {

TEST(AsCalledByAProxy, TheAddressIsTheOneThatOurProxyAdded) {
  const auto address_of = [](std::string_view header) {
    return as_called({header, {}, {}, {}}, true, "127.0.0.1", "").address;
  };
  EXPECT_EQ(address_of("203.0.113.9"), "203.0.113.9");
  EXPECT_EQ(address_of("1.2.3.4, 203.0.113.9"), "203.0.113.9") << "the first may be invented";
  EXPECT_EQ(address_of("2001:db8::1"), "2001:db8::1");
  EXPECT_EQ(address_of(""), "127.0.0.1");
  EXPECT_EQ(address_of("<script>"), "127.0.0.1");
  EXPECT_EQ(address_of(std::string(80, '1')), "127.0.0.1");
}

TEST(AsCalledByAProxy, NameSchemeAndPrefixAreTheBrowsersOwn) {
  const AsCalled called =
      as_called({"203.0.113.9", "museum.example", "https", "/robot"}, true, "127.0.0.1", "127.0.0.1:8080");
  EXPECT_EQ(called.host, "museum.example");
  EXPECT_TRUE(called.is_https);
  EXPECT_EQ(called.prefix, "/robot");
}

TEST(AsCalledByAProxy, OneThatIsNotOursIsNotBelieved) {
  const AsCalled called =
      as_called({"203.0.113.9", "museum.example", "https", "/robot"}, false, "192.0.2.1", "robot.local");
  EXPECT_EQ(called.address, "192.0.2.1");
  EXPECT_EQ(called.host, "robot.local");
  EXPECT_FALSE(called.is_https);
  EXPECT_EQ(called.prefix, "");
}

TEST(AsCalledByAProxy, WhereItSaysNothingTheRequestCounts) {
  const AsCalled called = as_called({}, true, "127.0.0.1", "museum.example");
  EXPECT_EQ(called.host, "museum.example");
  EXPECT_FALSE(called.is_https);
}

TEST(AsCalledByAProxy, OfListsTheLastCounts) {
  const AsCalled called =
      as_called({"", "evil.example, museum.example:8443 ", "http, HTTPS", "/x, /robot/"}, true, "::1", "a");
  EXPECT_EQ(called.host, "museum.example:8443");
  EXPECT_TRUE(called.is_https);
  EXPECT_EQ(called.prefix, "/robot");
  EXPECT_FALSE(as_called({"", "", "https,http", ""}, true, "::1", "a").is_https);
  EXPECT_TRUE(as_called({"", "", "wss", ""}, true, "::1", "a").is_https);
}

TEST(AsCalledByAProxy, WhatCannotBeIsNotTaken) {
  for (const char* host : {"", " ", "a b", "a\r\nb", "a;b", "a/b", "a\"b"})
    EXPECT_EQ(as_called({"", host, "", ""}, true, "::1", "own").host, "own") << host;
  for (const char* prefix :
       {"robot", "/", "//", "/a//b", "/..", "/a/../b", "/./a", "/a;b", "/a b", "/a\r\nb", "/a%20b", "http://x"})
    EXPECT_EQ(as_called({"", "", "", prefix}, true, "::1", "own").prefix, "") << prefix;
}

TEST(APathPrefix, IsOneOrMoreNames) {
  for (const char* good : {"/robot", "/museum/robot", "/~r.2", "/r_1-x", "/..."})
    EXPECT_TRUE(is_path_prefix(good)) << good;
  for (const char* bad : {"", "/", "robot", "/robot/", "//robot", "/.", "/../robot"})
    EXPECT_FALSE(is_path_prefix(bad)) << bad;
  EXPECT_FALSE(is_path_prefix("/" + std::string(300, 'a')));
}

TEST(WhatLiesBelowAPrefix, IsTheServersOwnPath) {
  EXPECT_EQ(below_prefix("/robot/live?thin", "/robot"), "/live?thin");
  EXPECT_EQ(below_prefix("/robot/", "/robot"), "/");
  EXPECT_EQ(below_prefix("/robot", "/robot"), "");
  EXPECT_EQ(below_prefix("/robot?a=1", "/robot"), "");
  EXPECT_EQ(below_prefix("/robots/live", "/robot"), std::nullopt);
  EXPECT_EQ(below_prefix("/live", "/robot"), std::nullopt);
  EXPECT_EQ(below_prefix("/live", ""), std::nullopt);
  EXPECT_EQ(below_prefix("/robot/robot/live", "/robot"), "/robot/live") << "once";
}

TEST(ACookieForASubPath, IsSentThereAlone) {
  const std::string cookie = "docent_login=abc; Path=/; HttpOnly; SameSite=Strict; Max-Age=9";
  EXPECT_EQ(cookie_for({}, cookie), cookie);
  EXPECT_EQ(cookie_for({"", "", false, "/robot"}, cookie),
            "docent_login=abc; Path=/robot/; HttpOnly; SameSite=Strict; Max-Age=9");
  EXPECT_EQ(cookie_for({"", "", true, ""}, cookie), cookie + "; Secure");
  EXPECT_EQ(cookie_for({"", "", true, ""}, cookie + "; Secure"), cookie + "; Secure");
}

}  // namespace
}  // namespace docent::telepresence
