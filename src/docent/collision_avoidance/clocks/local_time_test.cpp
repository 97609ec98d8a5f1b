#include "docent/collision_avoidance/clocks/local_time.h"

#include <gtest/gtest.h>

namespace docent::collision_avoidance::local_time_test {
namespace {

Time at(double time) { return time_from_seconds(time); }

TEST(LocalTime, OurOwnClockStandsAsItIs) {
  LocalTime local;
  for (int i = 0; i < 50; ++i) {
    const double now = 100.0 + 0.1 * i;
    EXPECT_EQ(local.receive("odometry", at(now), at(now)), at(now));
    EXPECT_EQ(local.receive("laser", at(now), at(now - 0.08)), at(now - 0.08));
    EXPECT_EQ(local.receive_handed_on("belief", at(now), at(now - 0.35)), at(now - 0.35));
  }
  EXPECT_EQ(local.receive("laser", at(105.0), at(104.3)), at(104.3)) << "late is late";
}

TEST(LocalTime, AnotherComputersClockIsTurnedIntoOurs) {
  for (const double ahead : {5.0, -5.0, 0.4, -0.4}) {
    SCOPED_TRACE(ahead);
    LocalTime local;
    double now = 100.0;
    for (int i = 0; i < 50; ++i, now += 0.1) {
      EXPECT_NEAR(to_seconds(local.receive("laser", at(now), at(now + ahead))), now, 1e-3);
    }
    EXPECT_NEAR(to_seconds(local.receive("laser", at(now), at(now + ahead - 0.3))), now - 0.3, 1e-3)
        << "this one came late";
  }
}

TEST(LocalTime, SourcesOfOneComputerStayTogetherHoweverLongEachTakes) {
  for (const double ahead : {5.0, -5.0}) {
    LocalTime local;
    double now = 100.0;
    Time odometry, laser, belief;
    for (int i = 0; i < 50; ++i, now += 0.1) {
      odometry = local.receive("odometry", at(now), at(now + ahead - 0.002));
      laser = local.receive("laser", at(now), at(now + ahead - 0.09));
      belief = local.receive_handed_on("belief", at(now), at(now + ahead - 0.4));
    }
    now -= 0.1;
    EXPECT_NEAR(to_seconds(odometry - laser), 0.088, 1e-6);
    EXPECT_NEAR(to_seconds(odometry - belief), 0.398, 1e-6);
    EXPECT_NEAR(to_seconds(odometry), now, 3e-3);
  }
}

TEST(LocalTime, EveryComputerHasItsOwn) {
  LocalTime local;
  double now = 100.0;
  Time odometry, laser, belief;
  for (int i = 0; i < 50; ++i, now += 0.1) {
    odometry = local.receive("odometry", at(now), at(now - 0.01));
    laser = local.receive("laser", at(now), at(now - 7.0));
    belief = local.receive_handed_on("belief", at(now), at(now - 7.2));
  }
  now -= 0.1;
  EXPECT_NEAR(to_seconds(odometry), now - 0.01, 1e-9);
  EXPECT_NEAR(to_seconds(laser), now, 1e-3);
  EXPECT_NEAR(to_seconds(belief), now - 0.2, 1e-3);
}

TEST(LocalTime, NothingLiesInTheFuture) {
  LocalTime local;
  for (int i = 0; i < 10; ++i) (void)local.receive("laser", at(100.0 + 0.1 * i), at(100.0 + 0.1 * i));
  EXPECT_EQ(local.receive("laser", at(101.0), at(111.0)), at(101.0));
  EXPECT_EQ(local.receive_handed_on("belief", at(101.0), at(111.0)), at(101.0));
}

TEST(LocalTime, AClockThatWasSetIsFollowed) {
  LocalTime local;
  for (int i = 0; i < 10; ++i) (void)local.receive("laser", at(100.0 + 0.1 * i), at(100.0 + 0.1 * i));
  for (int i = 10; i < 13; ++i) (void)local.receive("laser", at(100.0 + 0.1 * i), at(110.0 + 0.1 * i));
  EXPECT_NEAR(to_seconds(local.receive("laser", at(101.3), at(111.1))), 101.1, 1e-3);
}

TEST(LocalTime, AClockThatIsSetBackIsFollowedBesideOthersThatAreNot) {
  for (const double back : {0.12, 0.3, 5.0}) {
    SCOPED_TRACE(back);
    LocalTime local;
    double now = 100.0;
    for (int i = 0; i < 50; ++i, now += 0.1) {
      (void)local.receive("odometry", at(now), at(now - 0.01));
      (void)local.receive("laser", at(now), at(now - 0.06));
    }
    for (int i = 0; i < 10; ++i, now += 0.1) {
      (void)local.receive("odometry", at(now), at(now - 0.01 - back));
      (void)local.receive("laser", at(now), at(now - 0.06));
    }
    EXPECT_NEAR(to_seconds(local.receive("odometry", at(now), at(now - 0.01 - back))), now - 0.01, 2e-3);
    EXPECT_EQ(local.receive("laser", at(now), at(now - 0.06)), at(now - 0.06));
    EXPECT_EQ(local.receive_handed_on("belief", at(now), at(now - 0.1)), at(now - 0.1)) << "in local time already";
  }
}

}  // namespace
}  // namespace docent::collision_avoidance::local_time_test
