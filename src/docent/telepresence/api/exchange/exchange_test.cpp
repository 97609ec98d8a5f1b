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

}  // namespace
}  // namespace docent::telepresence
