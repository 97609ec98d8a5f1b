#include "docent/telepresence/api/call_limits.h"

#include <gtest/gtest.h>

namespace docent::telepresence {
namespace {

class CallLimitsTest : public testing::Test {
 protected:
  /// How many of these calls are let through, a second apart.
  int let_through(Scarce what, int calls, const std::function<std::string(int)>& address, bool is_far = false,
                  bool is_staff = false) {
    Endpoint endpoint;
    endpoint.method = "POST";
    endpoint.scarce = what;
    int through = 0;
    for (int i = 0; i < calls; ++i) {
      ApiRequest request;
      request.address = address(i);
      request.token = "token";
      request.is_far = is_far;
      now_ = now_ + seconds(1.0);
      last_ = limits_.why_not(request, endpoint, is_staff, now_);
      through += !last_;
    }
    return through;
  }
  static std::string one(int /*i*/) { return "192.0.2.1"; }

  ApiParams params_{.writes_per_second = 10.0};
  ForumParams forum_{.while_s = 600.0, .posts_of_address = 20, .reports_of_address = 10};
  CallLimits limits_{params_, forum_};
  Time now_ = time_from_seconds(1000.0);
  std::optional<ApiFault> last_;
};

TEST_F(CallLimitsTest, ManyNamesOfOneAddressWriteLittleTogether) {
  EXPECT_NEAR(let_through(Scarce::posts, 300, one), 20 + 10, 1) << "twenty at once, and ten more in five minutes";
  EXPECT_EQ(last_, ApiFault::too_often);
  EXPECT_NEAR(let_through(Scarce::reports, 300, one), 10 + 5, 1) << "reports are counted apart";
  EXPECT_EQ(let_through(Scarce::no, 300, one), 300);
  EXPECT_EQ(let_through(Scarce::posts, 20, [](int) { return "192.0.2.2"; }), 20) << "somebody else";
}

TEST_F(CallLimitsTest, AHouseholdOfIPv6IsOneAddress) {
  const auto address = [](int i) { return "2001:db8:1:2::" + std::to_string(i + 1); };
  EXPECT_NEAR(let_through(Scarce::posts, 300, address), 30, 1);
  const auto others = [](int i) { return "2001:db8:1:" + std::to_string(i + 10) + "::1"; };
  EXPECT_EQ(let_through(Scarce::posts, 300, others), 300);
}

TEST_F(CallLimitsTest, AFarGatewayThatInventsAddressesGetsTheShareOfFive) {
  const auto invented = [](int i) { return "far 192.0.2." + std::to_string(i); };
  EXPECT_NEAR(let_through(Scarce::posts, 250, invented, true), 100 + 250 / 6, 1);
  EXPECT_EQ(let_through(Scarce::posts, 10, one), 10) << "who is here notices nothing";
}

TEST_F(CallLimitsTest, WhatStrangersDoFromTheirAddressIsNoMatterOfStaff) {
  let_through(Scarce::posts, 300, one);
  EXPECT_EQ(let_through(Scarce::posts, 50, one, false, true), 50);
}

TEST_F(CallLimitsTest, CallsAreLimitedInAnyCase) {
  ApiRequest request;
  request.address = "192.0.2.1";
  Endpoint endpoint;
  endpoint.method = "POST";
  int through = 0;
  for (int i = 0; i < 1000; ++i) through += !limits_.why_not(request, endpoint, false, now_);
  EXPECT_EQ(through, 200) << "twenty seconds worth";
  EXPECT_EQ(limits_.why_not(request, endpoint, false, now_), ApiFault::too_fast);
}

}  // namespace
}  // namespace docent::telepresence
