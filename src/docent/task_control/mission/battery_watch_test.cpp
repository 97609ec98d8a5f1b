#include "docent/task_control/mission/battery_watch.h"

#include <gtest/gtest.h>

namespace docent::task_control {
namespace {

class BatteryWatchTest : public testing::Test {
 protected:
  /// A report a second.
  void pass(double duration_s, double rate, std::optional<bool> is_charging) {
    for (const double end = now_s + duration_s; now_s < end;) {
      now_s += 1.0;
      charge += rate;
      watch.report(charge, is_charging, time_from_seconds(now_s));
    }
  }
  [[nodiscard]] double thought(double later_s) const { return *watch.charge(time_from_seconds(now_s + later_s)); }

  double now_s = 0.0;
  double charge = 0.9;
  BatteryWatch watch{1e-4, 2e-4};
};

TEST_F(BatteryWatchTest, KnowsNothingBeforeTheFirstReport) {
  EXPECT_FALSE(watch.charge({}));
  EXPECT_FALSE(watch.is_silent(time_from_seconds(1000)));
}

TEST_F(BatteryWatchTest, MeasuresBothRates) {
  pass(300, -3e-4, false);
  EXPECT_NEAR(watch.drain_per_s(), 3e-4, 1e-6);
  pass(200, 4e-4, true);
  EXPECT_NEAR(watch.charge_per_s(), 4e-4, 1e-6);
  EXPECT_NEAR(watch.drain_per_s(), 3e-4, 1e-6) << "a charge says nothing of it";
  pass(1000, -0.5e-4, false);
  EXPECT_EQ(watch.drain_per_s(), 1e-4) << "a robot that stands now will drive";
}

TEST_F(BatteryWatchTest, TakesACorrectionForNoRate) {
  pass(10, 0.0, false);
  pass(1, -0.3, false);
  EXPECT_EQ(watch.drain_per_s(), 4e-4);
}

TEST_F(BatteryWatchTest, GoesOnWhileTheBatteryIsSilent) {
  pass(10, 0.0, false);
  EXPECT_EQ(thought(5.0), charge);
  EXPECT_NEAR(thought(1000.0), charge - 0.1, 1e-9);
  EXPECT_EQ(thought(1e6), 0.0);
}

TEST_F(BatteryWatchTest, ASilentBatteryIsNotThoughtToBecomeFull) {
  pass(10, 0.0, true);
  EXPECT_EQ(watch.is_charging(time_from_seconds(now_s)), true);
  EXPECT_EQ(thought(5000.0), charge);
  EXPECT_EQ(watch.is_charging(time_from_seconds(now_s + 5000.0)), std::nullopt);
  // The robot drives away, and the battery is still silent.
  watch.is_away_from_charger(time_from_seconds(now_s + 5000.0));
  EXPECT_NEAR(thought(6000.0), charge - 0.1, 1e-9);
}

TEST_F(BatteryWatchTest, WhatABatterySaysAwayFromTheChargerCounts) {
  pass(10, 0.0, true);
  watch.is_away_from_charger(time_from_seconds(now_s));
  EXPECT_EQ(watch.is_charging(time_from_seconds(now_s)), true);
}

}  // namespace
}  // namespace docent::task_control
