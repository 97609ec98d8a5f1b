#include "docent/task_control/mission/staff_call.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

namespace docent::task_control::staff_call_test {
namespace {

class StaffCallTest : public testing::Test {
 protected:
  /// Twice a second for so long; the charge changes by `per_s`.
  void pass(double duration_s, double per_s, bool is_at_charger = false) {
    for (const double end = now_s + duration_s; now_s < end; now_s += 0.5) {
      charge += 0.5 * per_s;
      const auto call = staff.watch(charge, is_at_charger, charge >= 0.95, time_from_seconds(now_s));
      if (!call) continue;
      EXPECT_EQ(call->kind, EventKind::staff_called);
      calls.push_back(call->subject);
      EXPECT_NEAR(call->value, charge, 1e-9);
    }
  }

  static constexpr double kDrain = -1.4e-4;   // [1/s]
  static constexpr double kCharges = 2.2e-4;  // [1/s]
  StaffCall staff{{}};
  double now_s = 1000.0;
  double charge = 0.5;
  std::vector<std::string> calls;
};

TEST_F(StaffCallTest, NobodyIsCalledAsLongAsAllIsWell) {
  pass(1800.0, kDrain);
  pass(1800.0, kCharges, true);
  EXPECT_TRUE(calls.empty());
  EXPECT_EQ(staff.told(), "");
}

TEST_F(StaffCallTest, AnOccupiedChargerIsToldAtOnceWhenLittleIsLeft) {
  charge = 0.2;
  staff.failed(ReasonWord::charger_occupied);
  pass(1.0, kDrain);
  EXPECT_EQ(calls, std::vector<std::string>{"charger_occupied"});
  EXPECT_NE(staff.told().find("stands on the charger"), std::string::npos);
  pass(500.0, kDrain);
  EXPECT_EQ(calls.size(), 1U) << "not again and again";
  pass(200.0, kDrain);
  EXPECT_EQ(calls.size(), 2U) << "but not once alone";
}

TEST_F(StaffCallTest, WithMoreChargeASecondFailureIsToldAndAWayThatIsBlockedLater) {
  staff.failed(ReasonWord::charger_occupied);
  pass(5.0, kDrain);
  EXPECT_TRUE(calls.empty()) << "it may have been somebody";
  staff.failed(ReasonWord::charger_occupied);
  pass(5.0, kDrain);
  EXPECT_EQ(calls.size(), 1U);
  StaffCall other{{}};
  for (int i = 0; i < 2; ++i) other.failed(ReasonWord::way_blocked);
  EXPECT_FALSE(other.watch(0.3, false, false, time_from_seconds(1.0)));
  other.failed(ReasonWord::way_blocked);
  EXPECT_TRUE(other.watch(0.3, false, false, time_from_seconds(2.0)));
}

TEST_F(StaffCallTest, WhateverIsKnownStaffAreCalledBeforeATenthIsLeft) {
  charge = 0.2;
  pass(900.0, kDrain);
  ASSERT_EQ(calls, std::vector<std::string>{"battery_low"});
  EXPECT_GT(charge, 0.07);
  StaffCall at_charger{{}};
  double left = 0.12;
  for (double s = 0.0; s < 600.0; s += 0.5) {
    left += 0.5 * kCharges;
    EXPECT_FALSE(at_charger.watch(left, true, false, time_from_seconds(s))) << "it charges";
  }
}

TEST_F(StaffCallTest, ABatteryThatOnlySaysThatItChargesIsFoundOut) {
  charge = 0.15;
  pass(280.0, -7e-5, true);
  EXPECT_TRUE(staff.has_no_current());
  EXPECT_EQ(calls, std::vector<std::string>{"charger_no_current"});
  EXPECT_GT(charge, 0.13);
  EXPECT_EQ(staff.failures(), 1);
  pass(300.0, kCharges, true);
  EXPECT_FALSE(staff.has_no_current()) << "somebody has plugged it in";
  EXPECT_EQ(staff.told(), "");
  EXPECT_EQ(staff.failures(), 0);
}

TEST_F(StaffCallTest, AGaugeThatStandsStillIsFoundOutLater) {
  charge = 0.4;
  pass(290.0, 0.0, true);
  EXPECT_FALSE(staff.has_no_current());
  pass(20.0, 0.0, true);
  EXPECT_TRUE(staff.has_no_current());
  StaffCall full{{}};
  for (double s = 0.0; s < 900.0; s += 1.0) (void)full.watch(0.97, true, true, time_from_seconds(s));
  EXPECT_FALSE(full.has_no_current()) << "a full one need not rise";
}

TEST_F(StaffCallTest, ACurrentThatStopsInTheMiddleIsFoundOut) {
  charge = 0.3;
  pass(600.0, kCharges, true);
  EXPECT_FALSE(staff.has_no_current());
  pass(260.0, -7e-5, true);
  EXPECT_TRUE(staff.has_no_current());
}

TEST_F(StaffCallTest, EachFailureDoublesTheWait) {
  EXPECT_EQ(staff.retry_s(30.0), 30.0);
  staff.failed(ReasonWord::charger_occupied);
  EXPECT_EQ(staff.retry_s(30.0), 30.0);
  staff.failed(ReasonWord::charger_occupied);
  EXPECT_EQ(staff.retry_s(30.0), 60.0);
  for (int i = 0; i < 40; ++i) staff.failed(ReasonWord::charger_occupied);
  EXPECT_EQ(staff.retry_s(30.0), 120.0);
  EXPECT_EQ(staff.retry_s(200.0), 200.0) << "no sooner than after a first failure";
}

TEST_F(StaffCallTest, ParametersHaveBounds) {
  EXPECT_TRUE(StaffCallParams{}.validate());
  const auto is_refused = [](const std::function<void(StaffCallParams&)>& change) {
    StaffCallParams params;
    change(params);
    return !params.validate();
  };
  EXPECT_TRUE(is_refused([](auto& p) { p.call_below = 1.5; }));
  EXPECT_TRUE(is_refused([](auto& p) { p.trouble_below = -0.1; }));
  EXPECT_TRUE(is_refused([](auto& p) { p.trouble_tries = 0; }));
  EXPECT_TRUE(is_refused([](auto& p) { p.way_tries = 0; }));
  EXPECT_TRUE(is_refused([](auto& p) { p.call_again_s = 0.0; }));
  EXPECT_TRUE(is_refused([](auto& p) { p.retry_most_s = -1.0; }));
  EXPECT_TRUE(is_refused([](auto& p) { p.current_s = 0.0; }));
}

}  // namespace
}  // namespace docent::task_control::staff_call_test
