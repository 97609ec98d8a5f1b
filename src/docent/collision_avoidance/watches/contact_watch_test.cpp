#include "docent/collision_avoidance/watches/contact_watch.h"

#include <gtest/gtest.h>

namespace docent::collision_avoidance::contact_watch_test {
namespace {

Time at(double time) { return time_from_seconds(100.0 + time); }

TEST(ContactWatch, StandsForASecondAndMayLeaveSooner) {
  ContactWatch watch;
  EXPECT_FALSE(watch.is_touched(at(0.0), watch.stands_for())) << "by nobody so far";
  watch.feel(at(0.0), Angle::degrees(0));
  EXPECT_TRUE(watch.is_touched(at(0.9), watch.stands_for()));
  EXPECT_FALSE(watch.is_touched(at(1.1), watch.stands_for()));
  EXPECT_TRUE(watch.is_touched(at(0.1), 0.2));
  EXPECT_FALSE(watch.is_touched(at(0.3), 0.2));
  EXPECT_FALSE(watch.may_leave(at(0.3)));
  EXPECT_TRUE(watch.may_leave(at(0.5)));
}

TEST(ContactWatch, ATouchElsewhereOrAfterAPauseIsAnotherOne) {
  ContactWatch watch;
  for (const double time : {0.0, 0.2, 0.4}) watch.feel(at(time), Angle::degrees(10));
  EXPECT_TRUE(watch.may_leave(at(0.5))) << "the same touch since the beginning";
  watch.feel(at(0.5), Angle::degrees(90));
  EXPECT_FALSE(watch.may_leave(at(0.6))) << "another place";
  watch.feel(at(2.0), Angle::degrees(90));
  EXPECT_FALSE(watch.may_leave(at(2.1))) << "after a pause";
}

}  // namespace
}  // namespace docent::collision_avoidance::contact_watch_test
