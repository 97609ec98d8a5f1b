#include "docent/task_control/mission_service/daily_tours.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace docent::task_control {
namespace {

museum::Museum museum_with_daily_tours() {
  museum::Museum museum;
  museum.languages = {"en", "de"};
  museum.modes = {{"open", {0.7, 0.0, {"09:00-18:00"}}}};
  museum.tours = {
      {"highlights", {{"en", "The highlights"}, {"de", "Die Höhepunkte"}}, {"zuse"}, {}, {11 * 60, 14 * 60}},
      {"night", {{"en", "At night"}, {"de", "Bei Nacht"}}, {"zuse"}, {}, {18 * 60 + 30}}};
  return museum;
}

/// Twice a minute, as the clock goes on.
struct Day {
  explicit Day(const museum::Museum& museum) : tours{museum} {}
  void pass(int from, int to, std::int64_t day = 1, bool is_open = true, bool may_speak = true) {
    for (int half = 2 * from; half < 2 * to; ++half) {
      const auto news = tours.look(half / 2, day, is_open, may_speak, time_from_seconds(30.0 * half));
      if (news.begins) begun.push_back(museum::clock_text(half / 2) + " " + news.begins->target);
      if (news.begins) ids.push_back(news.begins->id);
      if (!news.language.empty()) spoken.push_back(museum::clock_text(half / 2) + " " + news.language);
      if (news.soon && shown.empty()) shown = museum::clock_text(half / 2);
    }
  }
  DailyTours tours;
  std::vector<std::string> begun, ids, spoken;
  std::string shown;
};

TEST(DailyTours, AreShownThenSpokenOfThenBegun) {
  const museum::Museum museum = museum_with_daily_tours();
  Day day{museum};
  day.pass(13 * 60, 15 * 60);
  EXPECT_EQ(day.shown, "13:45");
  EXPECT_EQ(day.spoken, (std::vector<std::string>{"13:54 en", "13:55 de"}));
  EXPECT_EQ(day.begun, (std::vector<std::string>{"14:00 highlights"}));
}

TEST(DailyTours, BeginOnceADayAndAgainTheNextDay) {
  const museum::Museum museum = museum_with_daily_tours();
  Day day{museum};
  day.pass(0, 24 * 60, 1);
  day.pass(0, 12 * 60, 2);
  EXPECT_EQ(day.begun, (std::vector<std::string>{"11:00 highlights", "14:00 highlights", "11:00 highlights"}))
      << "not at half past six, when the museum is closed";
  EXPECT_NE(day.ids.front(), day.ids.back());
}

TEST(DailyTours, AMissionThatWasRestartedWishesForTheSameTourAgain) {
  const museum::Museum museum = museum_with_daily_tours();
  Day before{museum};
  before.pass(13 * 60 + 50, 14 * 60 + 1);
  Day after{museum};
  after.pass(14 * 60 + 1, 14 * 60 + 30);
  EXPECT_EQ(after.ids, before.ids) << "which the store knows";
  Day too_late{museum};
  too_late.pass(14 * 60 + 3, 14 * 60 + 30);
  EXPECT_TRUE(too_late.begun.empty());
}

TEST(DailyTours, NothingIsSaidWhileTheRobotSpeaksAndNothingBeginsWhereNobodyIsServed) {
  const museum::Museum museum = museum_with_daily_tours();
  Day busy{museum};
  busy.pass(13 * 60, 13 * 60 + 57, 1, true, false);
  EXPECT_TRUE(busy.spoken.empty());
  busy.pass(13 * 60 + 57, 14 * 60, 1, true, true);
  EXPECT_EQ(busy.spoken, (std::vector<std::string>{"13:57 en", "13:58 de"}));
  Day closed{museum};
  closed.pass(13 * 60, 15 * 60, 1, false);
  EXPECT_TRUE(closed.begun.empty());
  EXPECT_TRUE(closed.shown.empty());
}

TEST(DailyTours, HaveANameAndATimeInEachLanguage) {
  const museum::Museum museum = museum_with_daily_tours();
  EXPECT_EQ(name_and_time(museum, {"highlights", 14 * 60}, "de"), "Die Höhepunkte, 14:00");
}

}  // namespace
}  // namespace docent::task_control
