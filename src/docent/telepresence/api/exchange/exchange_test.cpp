#include "docent/telepresence/api/exchange/exchange.h"

#include <gtest/gtest.h>

namespace docent::telepresence {
namespace {

TEST(Cookies, ByTheirName) {
  EXPECT_EQ(cookie_value("docent_login=abc", "docent_login"), "abc");
  EXPECT_EQ(cookie_value("a=1; docent_login=abc; b=2", "docent_login"), "abc");
  EXPECT_EQ(cookie_value("xdocent_login=abc", "docent_login"), "");
  EXPECT_EQ(cookie_value("docent_login", "docent_login"), "");
  EXPECT_EQ(cookie_value(";;;=;docent_login=", "docent_login"), "");
  EXPECT_EQ(cookie_value("", "docent_login"), "");
}

TEST(AForwardedAddress, IsTheOneThatOurProxyAdded) {
  EXPECT_EQ(forwarded_address("203.0.113.9", "127.0.0.1"), "203.0.113.9");
  EXPECT_EQ(forwarded_address("1.2.3.4, 203.0.113.9", "127.0.0.1"), "203.0.113.9") << "the first may be invented";
  EXPECT_EQ(forwarded_address("2001:db8::1", "127.0.0.1"), "2001:db8::1");
  EXPECT_EQ(forwarded_address("", "127.0.0.1"), "127.0.0.1");
  EXPECT_EQ(forwarded_address("<script>", "127.0.0.1"), "127.0.0.1");
  EXPECT_EQ(forwarded_address(std::string(80, '1'), "127.0.0.1"), "127.0.0.1");
}

}  // namespace
}  // namespace docent::telepresence
