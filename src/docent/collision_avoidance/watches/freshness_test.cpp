#include "docent/collision_avoidance/watches/freshness.h"

#include <gtest/gtest.h>

namespace docent::collision_avoidance::freshness_test {
namespace {

TEST(Freshness, NothingIsFreshBeforeTheFirstMessage) { EXPECT_TRUE(Freshness{}.is_stale(time_from_seconds(100))); }

TEST(Freshness, SilenceMakesStale) {
  Freshness freshness;
  for (int i = 0; i <= 20; ++i) freshness.receive(time_from_seconds(0.1 * i), time_from_seconds(0.1 * i));
  EXPECT_NEAR(freshness.period(), 0.1, 1e-6);
  EXPECT_FALSE(freshness.is_stale(time_from_seconds(2.45)));
  EXPECT_TRUE(freshness.is_stale(time_from_seconds(2.55)));
}

TEST(Freshness, ASlowTopicHasTwoAndAHalfPeriods) {
  Freshness freshness;
  for (int i = 0; i <= 20; ++i) freshness.receive(time_from_seconds(0.4 * i), time_from_seconds(0.4 * i));
  EXPECT_FALSE(freshness.is_stale(time_from_seconds(8.9)));
  EXPECT_TRUE(freshness.is_stale(time_from_seconds(9.1)));
}

TEST(Freshness, AnotherClockIsNoLatenessButADelayIs) {
  Freshness freshness;
  for (int i = 0; i <= 20; ++i) freshness.receive(time_from_seconds(0.1 * i), time_from_seconds(0.1 * i - 7.0));
  EXPECT_NEAR(freshness.age(time_from_seconds(2.0)), 0.0, 1e-3);
  freshness.receive(time_from_seconds(2.1), time_from_seconds(2.1 - 7.6));  // this one was stamped 0.6 s before it came
  EXPECT_NEAR(freshness.age(time_from_seconds(2.1)), 0.6, 1e-2);
  EXPECT_TRUE(freshness.is_stale(time_from_seconds(2.1)));
}

TEST(Freshness, OneStampFromTheFutureIsForgotten) {
  Freshness freshness;
  for (int i = 0; i <= 20; ++i) freshness.receive(time_from_seconds(0.1 * i), time_from_seconds(0.1 * i));
  freshness.receive(time_from_seconds(2.1), time_from_seconds(12.1));
  for (int i = 22; i <= 24; ++i) freshness.receive(time_from_seconds(0.1 * i), time_from_seconds(0.1 * i));
  EXPECT_NEAR(freshness.age(time_from_seconds(2.4)), 0.0, 1e-3);
}

TEST(Freshness, AClockThatWasSetForwardIsBelievedAfterThreeMessages) {
  Freshness freshness;
  for (int i = 0; i <= 20; ++i) freshness.receive(time_from_seconds(0.1 * i), time_from_seconds(0.1 * i));
  for (int i = 21; i <= 23; ++i) freshness.receive(time_from_seconds(0.1 * i), time_from_seconds(0.1 * i + 10.0));
  EXPECT_NEAR(freshness.age(time_from_seconds(2.3)), 0.0, 1e-3);
  freshness.receive(time_from_seconds(2.4), time_from_seconds(2.4 + 10.0 - 0.7));
  EXPECT_TRUE(freshness.is_stale(time_from_seconds(2.4)));
}

TEST(Freshness, AClockThatWasSetBackIsLateForAMomentAndThenBelieved) {
  Freshness freshness;
  for (int i = 0; i <= 50; ++i) freshness.receive(time_from_seconds(0.1 * i), time_from_seconds(0.1 * i));
  for (int i = 51; i <= 70; ++i) freshness.receive(time_from_seconds(0.1 * i), time_from_seconds(0.1 * i - 0.4));
  EXPECT_NEAR(freshness.lateness(), 0.4, 0.01) << "it may be late in truth";
  for (int i = 71; i <= 100; ++i) freshness.receive(time_from_seconds(0.1 * i), time_from_seconds(0.1 * i - 0.4));
  EXPECT_NEAR(freshness.lateness(), 0.0, 0.01);
}

}  // namespace
}  // namespace docent::collision_avoidance::freshness_test
