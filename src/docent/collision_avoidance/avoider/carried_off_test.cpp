#include "docent/collision_avoidance/avoider/carried_off.h"

#include <gtest/gtest.h>

namespace docent::collision_avoidance::carried_off_test {
namespace {

using Finding = Succession::Finding;

Time at(double seconds) { return time_from_seconds(seconds); }

TEST(CarriedOff, StopsAtTheFirstStrangeSweepAndStaysUntilItKnowsWhere) {
  CarriedOff carried{1};
  carried.see(0, at(1.0), Finding::follows);
  EXPECT_FALSE(carried.forbids_driving(at(1.0)));
  carried.see(0, at(1.1), Finding::suspect);
  EXPECT_TRUE(carried.forbids_driving(at(1.1))) << "at once";
  EXPECT_EQ(carried.times(), 0U) << "it may be garbage";
  carried.see(0, at(1.2), Finding::broken);
  carried.see(0, at(1.3), Finding::follows);
  EXPECT_EQ(carried.times(), 1U);
  EXPECT_TRUE(carried.forbids_driving(at(1.3)));
  for (const double time : {1.4, 1.5, 1.6}) carried.believe(at(time), true);
  EXPECT_TRUE(carried.is_unsettled()) << "that was still said of the place before";
  carried.believe(at(1.8), true);
  carried.believe(at(1.9), false);
  carried.believe(at(2.0), true);
  carried.believe(at(2.1), true);
  EXPECT_TRUE(carried.is_unsettled()) << "not yet surely";
  carried.believe(at(2.2), true);
  EXPECT_FALSE(carried.is_unsettled());
  EXPECT_FALSE(carried.forbids_driving(at(2.2)));
}

TEST(CarriedOff, OneSweepOfGarbageHoldsItUpForAMomentOnly) {
  CarriedOff carried{1};
  carried.see(0, at(1.0), Finding::suspect);
  EXPECT_TRUE(carried.forbids_driving(at(1.0)));
  carried.see(0, at(1.1), Finding::follows);
  EXPECT_FALSE(carried.forbids_driving(at(1.1)));
  EXPECT_EQ(carried.times(), 0U);
}

TEST(CarriedOff, AScannerThatGoesOnSaysThatTheOtherErrs) {
  CarriedOff carried{2};
  for (double time = 1.0; time < 1.55; time += 0.1) {
    carried.see(0, at(time), time < 1.25 ? Finding::follows : time < 1.35 ? Finding::suspect : Finding::broken);
    carried.see(1, at(time), Finding::follows);
    EXPECT_FALSE(carried.forbids_driving(at(time))) << time;
  }
  EXPECT_EQ(carried.times(), 0U);
}

TEST(CarriedOff, ScannersThatTakeTurnsAreWaitedFor) {
  CarriedOff carried{2};
  carried.see(0, at(1.00), Finding::follows);
  carried.see(1, at(1.05), Finding::follows);
  carried.see(0, at(1.10), Finding::suspect);  // carried off between
  EXPECT_TRUE(carried.forbids_driving(at(1.1)));
  carried.see(1, at(1.15), Finding::suspect);
  carried.see(0, at(1.20), Finding::broken);
  EXPECT_EQ(carried.times(), 1U);
  carried.see(1, at(1.25), Finding::broken);
  carried.see(0, at(1.30), Finding::follows);
  carried.see(1, at(1.35), Finding::follows);
  EXPECT_EQ(carried.times(), 1U) << "it was one carrying";
  EXPECT_TRUE(carried.forbids_driving(at(1.35)));
}

TEST(CarriedOff, ASilentOneAndOneThatSeesNothingAreNotWaitedFor) {
  CarriedOff carried{3};
  carried.see(1, at(0.2), Finding::follows);  // dead since
  carried.see(0, at(1.0), Finding::follows);
  carried.see(2, at(1.0), Finding::untold);
  carried.see(0, at(1.1), Finding::suspect);
  carried.see(0, at(1.2), Finding::broken);
  EXPECT_EQ(carried.times(), 1U);
}

TEST(CarriedOff, LaterItCreeps) {
  CarriedOff carried{1};
  carried.see(0, at(1.0), Finding::suspect);
  carried.see(0, at(1.1), Finding::broken);
  SpeedCap at_first{0.7, {}};
  carried.cap(at(2.0), at_first);
  EXPECT_EQ(at_first.speed, 0.0);
  SpeedCap later{0.7, {}};
  carried.cap(at(30.0), later);
  EXPECT_EQ(later.speed, CarriedOffParams{}.creep);
  EXPECT_FALSE(carried.forbids_driving(at(30.0)));
  EXPECT_FALSE(later.reason.empty());
}

}  // namespace
}  // namespace docent::collision_avoidance::carried_off_test
