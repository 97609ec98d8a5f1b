#include "docent/task_control/mission/charge_plan.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>

namespace docent::task_control::charge_plan_test {
namespace {

constexpr double kDrain = 1.4e-4;  // [1/s]

void live(ChargePlan& plan, int hour, double share) {
  double now_s = 1e6 * (hour + 1);
  for (int i = 0; i < 7200; ++i, now_s += 1.0)
    plan.demand().observe(hour, i % 100 < 100.0 * share, time_from_seconds(now_s));
}

TEST(ChargePlan, InBusyHoursAndBeforeThemEveryGapIsForCharging) {
  ChargePlan plan{{}};
  for (const int hour : {9, 10, 13, 14, 15}) live(plan, hour, 0.05);
  for (const int hour : {11, 12}) live(plan, hour, 0.8);
  plan.set_hour(11);
  EXPECT_LT(plan.missing_in_gap(0.25), 0.1);
  plan.set_hour(10);
  EXPECT_LT(plan.missing_in_gap(0.25), 0.1) << "the crowd is coming";
  plan.set_hour(14);
  EXPECT_EQ(plan.missing_in_gap(0.25), 0.25);
  EXPECT_EQ((ChargePlan{{.in_gaps = false}}.missing_in_gap(0.25)), 0.25);
}

TEST(ChargePlan, ChargesForWhatWaits) {
  const ChargePlan plan{{}};
  EXPECT_NEAR(plan.gain_for({1, 0}, 0.25, kDrain), 0.1, 1e-9) << "at least that";
  EXPECT_NEAR(plan.gain_for({3, 2}, 0.25, kDrain), 1.25 * kDrain * (3 * 110.0 + 2 * 360.0), 1e-9);
  EXPECT_EQ(plan.gain_for({20, 5}, 0.25, kDrain), 0.25);
  EXPECT_EQ(plan.gain_for({20, 5}, 0.05, kDrain), 0.05);
  EXPECT_EQ((ChargePlan{{.in_gaps = false}}.gain_for({1, 0}, 0.25, kDrain)), 0.25);
}

TEST(ChargePlan, WhoeverWaitsIsServedFirstUnlessTheNextHourIsBusier) {
  ChargePlan plan{{}};
  live(plan, 10, 0.2);
  live(plan, 11, 0.9);
  plan.set_hour(11);
  EXPECT_TRUE(plan.may_charge_before({}));
  EXPECT_FALSE(plan.may_charge_before({1, 0}));
  plan.set_hour(10);
  EXPECT_TRUE(plan.may_charge_before({1, 0}));
  EXPECT_FALSE(plan.may_charge_before({2, 1}));
}

TEST(ChargePlan, CountsWhatWaitsAndNotHowMany) {
  RequestBoard board;
  const auto ask = [&](const std::string& id, RequestKind kind, const std::string& target, int viewpoint = -1) {
    board.add({id, {}, RequestSource::web, "", kind, target, viewpoint, "en"}, RequestStatus::queued, {}, {});
  };
  ask("1", RequestKind::exhibit, "a");
  ask("2", RequestKind::exhibit, "a");
  ask("3", RequestKind::exhibit, "a", 2);
  ask("4", RequestKind::tour, "both");
  ask("5", RequestKind::tour, "both");
  const Waiting waiting = waiting_on(board);
  EXPECT_EQ(waiting.exhibits, 2);
  EXPECT_EQ(waiting.tours, 1);
}

TEST(ChargePlan, ParametersHaveBounds) {
  EXPECT_TRUE(ChargePlanParams{}.validate());
  const auto is_refused = [](const std::function<void(ChargePlanParams&)>& change) {
    ChargePlanParams params;
    change(params);
    return !params.validate();
  };
  EXPECT_TRUE(is_refused([](auto& p) { p.busy_share = -0.1; }));
  EXPECT_TRUE(is_refused([](auto& p) { p.gap_missing = 0.0; }));
  EXPECT_TRUE(is_refused([](auto& p) { p.least_gain = 2.0; }));
  EXPECT_TRUE(is_refused([](auto& p) { p.visit_s = 0.0; }));
  EXPECT_TRUE(is_refused([](auto& p) { p.tour_s = 0.0; }));
  EXPECT_TRUE(is_refused([](auto& p) { p.spare_factor = 0.5; }));
  EXPECT_TRUE(is_refused([](auto& p) { p.rises = 1.0; }));
  EXPECT_TRUE(is_refused([](auto& p) { p.few = -1; }));
}

}  // namespace
}  // namespace docent::task_control::charge_plan_test
