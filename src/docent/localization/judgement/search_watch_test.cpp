#include "docent/localization/judgement/search_watch.h"

#include <gtest/gtest.h>

#include "docent/base/random.h"

namespace docent::localization {
namespace {

constexpr double kView = 0.4;  // [m] between views

/// Searches of a robot that drives so far [m] and keeps its place; `nats` of a view.
template <class Nats>
int searches_in(SearchWatch& watch, double way, Nats nats, bool in_doubt = false) {
  int searches = 0;
  for (double driven = 0.0; driven < way; driven += kView) {
    watch.see(kView, nats());
    if (!watch.is_due(true, in_doubt)) continue;
    watch.searched();
    ++searches;
  }
  return searches;
}

TEST(SearchWatch, ARobotThatIsRightSearchesLessAndLess) {
  SearchWatch watch{{}};
  EXPECT_TRUE(watch.is_due(true, false)) << "where it begins";
  watch.searched();
  Rng rng{1};
  const auto usual = [&] { return rng.uniform(0.0, 0.9); };  // of a packed hall
  EXPECT_EQ(searches_in(watch, 6.5, usual), 1);
  EXPECT_EQ(searches_in(watch, 12.5, usual), 1);
  EXPECT_LE(searches_in(watch, 1000.0, usual), 23);
  EXPECT_GE(searches_in(watch, 1000.0, usual), 18) << "and never stops looking";
}

TEST(SearchWatch, ViewsThatAreALittleWorseThanUsualAddUp) {
  SearchWatch watch{{}};
  watch.searched();
  searches_in(watch, 500.0, [] { return 0.2; });
  int views = 0;
  while (!watch.is_due(true, false) && views < 1000) {
    watch.see(kView, 1.2);
    ++views;
  }
  EXPECT_LE(views, 9) << "within four metres";
  EXPECT_GE(views, 7);
  EXPECT_TRUE(watch.is_suspicious());
  watch.searched();
  EXPECT_FALSE(watch.is_suspicious());
  EXPECT_EQ(searches_in(watch, 6.5, [] { return 0.2; }), 1) << "it is wary for a while";
}

TEST(SearchWatch, OneBadViewIsPeopleAndManyAreAnotherPlace) {
  SearchWatch watch{{}};
  watch.searched();
  searches_in(watch, 500.0, [] { return 0.2; });
  watch.see(kView, 3.5);
  EXPECT_FALSE(watch.is_due(true, false));
  for (int i = 0; i < 10; ++i) watch.see(0.0, 0.2);
  EXPECT_FALSE(watch.is_suspicious());
  for (int i = 0; i < 4; ++i) watch.see(kView, 3.5);
  EXPECT_TRUE(watch.is_due(true, false));
}

TEST(SearchWatch, ARobotInDoubtSearchesAsOftenAsOneThatIsNew) {
  SearchWatch watch{{}};
  watch.searched();
  searches_in(watch, 500.0, [] { return 0.2; });
  const int searches = searches_in(
      watch, 60.0, [] { return 0.2; }, true);
  EXPECT_GE(searches, 8);
  EXPECT_LE(searches, 11);
}

TEST(SearchWatch, ARobotWithoutAPlaceSearchesAllTheTime) {
  SearchWatch watch{{}};
  watch.searched();
  watch.see(1.4, 0.0);
  EXPECT_FALSE(watch.is_due(false, false));
  watch.see(0.2, 0.0);
  EXPECT_TRUE(watch.is_due(false, false));
  watch.searched();
  watch.begin();
  EXPECT_TRUE(watch.is_due(true, false));
}

}  // namespace
}  // namespace docent::localization
