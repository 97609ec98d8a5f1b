#include "docent/people/groups.h"

#include <gtest/gtest.h>

namespace docent::people {
namespace {

using Ids = std::vector<std::uint32_t>;

TEST(Groups, FriendsAreOneGroupAndPassersByAreNot) {
  Groups groups{{}};
  Ids found;
  for (int i = 0; i <= 40; ++i) {
    const double t = 0.1 * i;
    const std::vector<TrackedPerson> people{{7, {t, 0.0}, {1.0, 0.0}},         // two who walk side by side,
                                            {4, {t, 0.8}, {1.0, 0.0}},         //
                                            {9, {t - 1.0, 0.4}, {1.0, 0.0}},   // a third behind them
                                            {2, {4.0 - t, 0.4}, {-1.0, 0.0}},  // one who comes against them
                                            {3, {9.0, 9.0}, {}}};
    found = groups.update(people, time_from_seconds(t));
  }
  EXPECT_EQ(found, (Ids{4, 4, 4, 0, 0}));
}

TEST(Groups, WhoLeavesIsAloneSoon) {
  Groups groups{{}};
  for (int i = 0; i <= 40; ++i) {
    const std::vector<TrackedPerson> people{{1, {0.0, 0.0}, {}}, {2, {0.9, 0.0}, {}}};
    const Ids found = groups.update(people, time_from_seconds(0.1 * i));
    EXPECT_EQ(found, i < 20 ? (Ids{0, 0}) : i > 21 ? (Ids{1, 1}) : found);
  }
  Ids found;
  for (int i = 41; i <= 80; ++i) {
    const std::vector<TrackedPerson> people{{1, {0.0, 0.0}, {}}, {2, {0.9 + 0.1 * (i - 40), 0.0}, {1.0, 0.0}}};
    found = groups.update(people, time_from_seconds(0.1 * i));
  }
  EXPECT_EQ(found, (Ids{0, 0}));
}

}  // namespace
}  // namespace docent::people
