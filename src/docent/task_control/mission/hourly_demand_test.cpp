#include "docent/task_control/mission/hourly_demand.h"

#include <gtest/gtest.h>

#include <cmath>

namespace docent::task_control::hourly_demand_test {
namespace {

class HourlyDemandTest : public testing::Test {
 protected:
  void pass(int hour, double hours, bool is_wanted) {
    for (const double end = now_s + 3600.0 * hours; now_s < end; now_s += 0.5)
      demand.observe(hour, is_wanted, time_from_seconds(now_s));
  }
  double now_s = 100.0;
  HourlyDemand demand;
};

TEST_F(HourlyDemandTest, AnHourIsAsItWas) {
  EXPECT_EQ(demand.share(11), HourlyDemand::kPrior);
  for (int day = 0; day < 5; ++day) {
    pass(10, 1.0, false);
    pass(11, 0.8, true);
    pass(11, 0.2, false);
  }
  EXPECT_LT(demand.share(10), 0.1);
  EXPECT_NEAR(demand.share(11), 0.8, 0.06);
  EXPECT_NEAR(demand.share(15), 0.4, 0.06) << "never seen: as the day is";
}

TEST_F(HourlyDemandTest, WhatChangesIsLearnedAnewWithinAWeek) {
  for (int day = 0; day < 30; ++day) pass(10, 1.0, true);
  EXPECT_GT(demand.share(10), 0.95);
  for (int day = 0; day < 7; ++day) pass(10, 1.0, false);
  EXPECT_LT(demand.share(10), 0.4);
}

TEST_F(HourlyDemandTest, SurvivesARestartAndWritesNowAndThen) {
  int writes = 0;
  for (int i = 0; i < 120; ++i) {
    pass(10, 1.0 / 60.0, i % 2 == 0);
    writes += demand.unstored().empty() ? 0 : 1;
    demand.mark_stored();
  }
  EXPECT_GT(writes, 60);
  pass(10, 0.1, true);
  HourlyDemand other;
  const auto rows = demand.unstored();
  ASSERT_EQ(rows.size(), 1U);
  other.restore(rows);
  EXPECT_NEAR(other.share(10), demand.share(10), 0.01);
}

TEST_F(HourlyDemandTest, DamagedRowsAndPausesTeachNothing) {
  const std::vector<LessonRow> damaged{{{LessonKind::demand, "10"}, {std::nan(""), 1.0, 0.0, 0.0}},
                                       {{LessonKind::demand, "77"}, {3.0, 1.0, 0.0, 0.0}},
                                       {{LessonKind::demand, "11"}, {1.0, 2.0, 0.0, 0.0}},
                                       {{LessonKind::hour, "12"}, {3.0, 3.0, 0.0, 0.0}}};
  demand.restore(damaged);
  for (const int hour : {10, 11, 12}) EXPECT_EQ(demand.share(hour), HourlyDemand::kPrior) << hour;
  demand.observe(10, true, time_from_seconds(1.0));
  demand.observe(10, true, time_from_seconds(5000.0));
  EXPECT_EQ(demand.share(10), HourlyDemand::kPrior);
}

}  // namespace
}  // namespace docent::task_control::hourly_demand_test
