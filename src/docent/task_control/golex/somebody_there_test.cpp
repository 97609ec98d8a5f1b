#include "docent/task_control/golex/somebody_there.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace docent::task_control::somebody_there_test {
namespace {

Time at(double s) { return time_from_seconds(s); }

TEST(SomebodyThere, WhoWasSeenToWalkIsSomebodyAlsoStanding) {
  SomebodyThere there;
  there.see(std::vector<PersonSeen>{{1, {5, 0}, 0.8}}, at(1.0));
  EXPECT_FALSE(there.is_near({0, 0}, at(1.0)));
  there.see(std::vector<PersonSeen>{{1, {0.5, 0}, 0.0}}, at(2.0));
  EXPECT_TRUE(there.is_near({0, 0}, at(2.0)));
}

TEST(SomebodyThere, WhatNeverMovedMayBeAStool) {
  SomebodyThere there;
  for (double s = 1.0; s < 60.0; s += 0.1) there.see(std::vector<PersonSeen>{{1, {0.1, 0}, 0.05}}, at(s));
  EXPECT_FALSE(there.is_near({0, 0}, at(60.0)));
}

TEST(SomebodyThere, WhatStoodThereBeforeAnybodyCameStaysAThing) {
  SomebodyThere there;
  for (double s = 1.0; s < 5.0; s += 0.2) EXPECT_TRUE(there.is_thing({0, 0}, true, at(s)));
  there.see(std::vector<PersonSeen>{{1, {0.3, 0}, 0.8}}, at(5.0));
  EXPECT_TRUE(there.is_thing({0, 0}, true, at(5.0))) << "somebody passes, or a track stays with it";
  EXPECT_FALSE(there.is_thing({0, 0}, false, at(5.2))) << "gone";
  EXPECT_FALSE(there.is_thing({0, 0}, true, at(5.4))) << "whoever came now may be who walked";
}

TEST(SomebodyThere, WhoHasNotMovedForLongMayBeAStool) {
  SomebodyThere there;
  there.see(std::vector<PersonSeen>{{1, {0.3, 0}, 0.8}}, at(1.0));
  for (double s = 1.1; s < 30.0; s += 0.1) {
    there.see(std::vector<PersonSeen>{{1, {0.3, 0}, 0.0}}, at(s));
    if (std::abs(s - 21.0) > 0.05) {
      EXPECT_EQ(there.is_near({0, 0}, at(s)), s < 21.0) << s;
    }
  }
}

TEST(SomebodyThere, WhoIsNoLongerFollowedIsForgotten) {
  SomebodyThere there;
  there.see(std::vector<PersonSeen>{{1, {0.1, 0}, 0.8}}, at(1.0));
  EXPECT_FALSE(there.is_near({0, 0}, at(3.0))) << "nothing was heard for long";
  there.see({}, at(3.0));
  there.see(std::vector<PersonSeen>{{1, {0.1, 0}, 0.0}}, at(3.1));
  EXPECT_FALSE(there.is_near({0, 0}, at(3.1))) << "a new one of the same number";
}

}  // namespace
}  // namespace docent::task_control::somebody_there_test
