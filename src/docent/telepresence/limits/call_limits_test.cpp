#include "docent/telepresence/limits/call_limits.h"

#include <gtest/gtest.h>

#include <functional>

namespace docent::telepresence {
namespace {

using Pace = CallLimits::Pace;

class CallLimitsTest : public testing::Test {
 protected:
  /// How many of these calls are let through, a second apart.
  int let_through(CountedCall call, int calls, const std::function<std::string(int)>& caller) {
    int through = 0;
    for (int i = 0; i < calls; ++i) {
      call.caller = caller(i);
      now_ = now_ + seconds(1.0);
      last_ = limits_.take(call, now_);
      through += last_ == Pace::fine;
    }
    return through;
  }
  static std::string one(int /*i*/) { return "192.0.2.1"; }
  static CountedCall of(Scarce what) { return {.caller = "", .changes = true, .scarce = what}; }

  CallLimits limits_{{{5.0, 50.0}, {10.0, 200.0}, {20.0 / 600.0, 20.0}, {10.0 / 600.0, 10.0}}};
  Time now_ = time_from_seconds(1000.0);
  Pace last_ = Pace::fine;
};

TEST_F(CallLimitsTest, ManyNamesOfOneAddressWriteLittleTogether) {
  EXPECT_NEAR(let_through(of(Scarce::posts), 300, one), 20 + 10, 1) << "twenty at once, ten more in five minutes";
  EXPECT_EQ(last_, Pace::too_often);
  EXPECT_NEAR(let_through(of(Scarce::reports), 300, one), 10 + 5, 1) << "reports are counted apart";
  EXPECT_EQ(let_through(of(Scarce::no), 300, one), 300);
  EXPECT_EQ(let_through(of(Scarce::posts), 20, [](int) { return "192.0.2.2"; }), 20) << "somebody else";
}

TEST_F(CallLimitsTest, AFarGatewayThatInventsAddressesGetsTheShareOfFive) {
  CountedCall far = of(Scarce::posts);
  far.is_far = true;
  EXPECT_NEAR(let_through(far, 250, [](int i) { return "far " + std::to_string(i); }), 100 + 250 / 6, 2);
  EXPECT_EQ(let_through(of(Scarce::posts), 10, one), 10) << "who is here notices nothing";
}

TEST_F(CallLimitsTest, WhatStrangersDoFromTheirAddressIsNoMatterOfStaff) {
  let_through(of(Scarce::posts), 300, one);
  CountedCall ada = of(Scarce::posts);
  ada.is_staff = true;
  EXPECT_EQ(let_through(ada, 50, [](int) { return "login of ada"; }), 50);
}

TEST_F(CallLimitsTest, CallsAreLimitedInAnyCase) {
  int writes = 0, reads = 0;
  for (int i = 0; i < 1000; ++i) {
    writes += limits_.take({.caller = "192.0.2.1", .changes = true}, now_) == Pace::fine;
    reads += limits_.take({.caller = "192.0.2.1"}, now_) == Pace::fine;
  }
  EXPECT_EQ(writes, 200);
  EXPECT_EQ(reads, 50);
  EXPECT_EQ(limits_.take({.caller = "192.0.2.1"}, now_), Pace::too_fast);
}

}  // namespace
}  // namespace docent::telepresence
