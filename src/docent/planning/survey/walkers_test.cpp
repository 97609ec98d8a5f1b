#include "docent/planning/survey/walkers.h"

#include <gtest/gtest.h>

#include <vector>

namespace docent::planning::walkers_test {
namespace {

TEST(Walkers, WhoWalksIsSomebodyAndWhatStandsMayBeAColumn) {
  Walkers walkers;
  std::vector<TrackedPerson> people{{1, {2.0, 0.0}}, {2, {4.0, 0.0}}};
  walkers.note(people);
  EXPECT_TRUE(walkers.places().empty());
  people[1].place.x = 4.6;
  walkers.note(people);
  EXPECT_TRUE(walkers.places().empty()) << "who shifts from foot to foot";
  people[1].place.x = 4.9;
  walkers.note(people);
  ASSERT_EQ(walkers.places().size(), 1U);
  EXPECT_NEAR(walkers.places().front().x, 4.9, 1e-6);
  walkers.note(people);
  EXPECT_EQ(walkers.places().size(), 1U) << "who walked and stands now is still somebody";
  people.pop_back();
  walkers.note(people);
  EXPECT_TRUE(walkers.places().empty());
}

TEST(Walkers, WhoComesBackUnderTheSameNumberIsNewHere) {
  Walkers walkers;
  walkers.note(std::vector<TrackedPerson>{{7, {0.0, 0.0}}});
  walkers.note({});
  walkers.note(std::vector<TrackedPerson>{{7, {5.0, 0.0}}});
  EXPECT_TRUE(walkers.places().empty());
}

}  // namespace
}  // namespace docent::planning::walkers_test
