#include "docent/visualization/diagnostics.h"

#include <gtest/gtest.h>

#include "docent/messages/message_fitness.h"

namespace docent::visualization {
namespace {

docent_msgs::Health health(const std::string& module, const std::string& state, const std::string& reason) {
  docent_msgs::Health health;
  health.module = module;
  health.state = state;
  health.reason = reason;
  health.pid = 12;
  health.step_p99_ms = 1.25;
  return health;
}

TEST(Diagnostics, HaveALevelForEachState) {
  Diagnostics diagnostics;
  const Time now = time_from_seconds(5.0);
  diagnostics.hear(health("avoid", "ready", ""), now);
  diagnostics.hear(health("localize", "degraded", "no scan"), now);
  diagnostics.hear(health("map", "starting", ""), now);
  diagnostics.hear(health("plan", "faulted", "no map"), now);
  const auto array = diagnostics.message(now);
  EXPECT_EQ(array.header.stamp.sec, 5);
  ASSERT_EQ(array.status.size(), 4U);
  EXPECT_EQ(array.status[0].name, "docent_avoid: health");
  EXPECT_EQ(array.status[0].level, 0);
  EXPECT_EQ(array.status[0].message, "ready");
  EXPECT_EQ(array.status[1].level, 1);
  EXPECT_EQ(array.status[1].message, "no scan");
  EXPECT_EQ(array.status[2].level, 1);
  EXPECT_EQ(array.status[2].message, "starting");
  EXPECT_EQ(array.status[3].level, 2);
  EXPECT_EQ(array.status[3].values.at(1).value, "12");
  EXPECT_FALSE(fault_of(array));
}

TEST(Diagnostics, AModuleThatFallsSilentIsStaleUntilItSpeaks) {
  Diagnostics diagnostics;
  diagnostics.hear(health("avoid", "ready", ""), time_from_seconds(5.0));
  EXPECT_EQ(diagnostics.message(time_from_seconds(7.0)).status.at(0).level, 0);
  EXPECT_EQ(diagnostics.message(time_from_seconds(7.5)).status.at(0).level, 3);
  diagnostics.hear(health("avoid", "ready", ""), time_from_seconds(8.0));
  EXPECT_EQ(diagnostics.message(time_from_seconds(8.0)).status.at(0).level, 0);
}

TEST(Diagnostics, AStrangerDoesNotFillThem) {
  Diagnostics diagnostics;
  for (int i = 0; i < 1000; ++i) diagnostics.hear(health(std::to_string(i), "ready", ""), Time{});
  EXPECT_EQ(diagnostics.message(Time{}).status.size(), 100U);
}

}  // namespace
}  // namespace docent::visualization
