#include "docent/museum/day_plan.h"

#include <gtest/gtest.h>

namespace docent::museum {
namespace {

Museum museum_with_evening() {
  Museum museum;
  museum.modes = {
      {"open", {0.7, 0.0, {"09:00-17:00"}}}, {"web", {0.4, 30.0, {"18:30-01:00"}}}, {"closed", {1.63, 0.0, {}}}};
  return museum;
}

TEST(DayPlan, SaysWhatComesNextAndWhen) {
  const Museum museum = museum_with_evening();
  EXPECT_EQ(next_mode(museum, 8 * 60), (NextMode{"open", 9 * 60}));
  EXPECT_EQ(next_mode(museum, 9 * 60), (NextMode{"closed", 17 * 60}));
  EXPECT_EQ(next_mode(museum, 17 * 60), (NextMode{"web", 18 * 60 + 30}));
  EXPECT_EQ(next_mode(museum, 23 * 60), (NextMode{"closed", 60})) << "past midnight";
  EXPECT_EQ(next_mode(museum, 30), (NextMode{"closed", 60}));
}

TEST(DayPlan, AgreesWithTheModeOfEachMinute) {
  const Museum museum = museum_with_evening();
  for (int minute = 0; minute < 24 * 60; ++minute) {
    const auto next = next_mode(museum, minute);
    ASSERT_TRUE(next.has_value()) << minute;
    int then = minute;
    do then = (then + 1) % (24 * 60);
    while (mode_at(museum, then) == mode_at(museum, minute));
    EXPECT_EQ(*next, (NextMode{mode_at(museum, then), then})) << minute;
  }
}

TEST(DayPlan, NothingComesWhereTheHoursSayTheSameAllDay) {
  Museum museum;
  EXPECT_EQ(next_mode(museum, 600), std::nullopt);
  museum.modes = {{"open", {0.7, 0.0, {}}}, {"web", {0.4, 30.0, {}}}};
  EXPECT_EQ(next_mode(museum, 600), std::nullopt);
}

TEST(DayPlan, SaysWhichDailyTourComesNext) {
  Museum museum = museum_with_evening();
  museum.tours = {{"late", {}, {}, 6.0, {16 * 60, 19 * 60}}, {"early", {}, {}, 6.0, {9 * 60 + 5, 16 * 60 + 10}}};
  EXPECT_EQ(next_daily_tour(museum, 9 * 60, 10), (DailyTour{"early", 9 * 60 + 5}));
  EXPECT_EQ(next_daily_tour(museum, 9 * 60, 4), std::nullopt);
  EXPECT_EQ(next_daily_tour(museum, 15 * 60 + 59, 60), (DailyTour{"late", 16 * 60}));
  EXPECT_EQ(next_daily_tour(museum, 16 * 60, 0), (DailyTour{"late", 16 * 60}));
  EXPECT_EQ(next_daily_tour(museum, 18 * 60 + 50, 30), std::nullopt) << "the Web's hours";
  EXPECT_EQ(next_daily_tour(museum, 23 * 60, 11 * 60), (DailyTour{"early", 9 * 60 + 5})) << "past midnight";
}

TEST(DayPlan, KnowsWhichModeWasMeant) {
  EXPECT_EQ(mode_meant("opn"), "; did you mean 'open'?");
  EXPECT_EQ(mode_meant("hour"), "; did you mean 'hours'?");
  EXPECT_EQ(mode_meant("Sunday"), "");
}

TEST(DayPlan, AClockHasTwoDigitsEach) { EXPECT_EQ(clock_text(9 * 60 + 5), "09:05"); }

}  // namespace
}  // namespace docent::museum
