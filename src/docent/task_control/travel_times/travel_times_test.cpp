#include "docent/task_control/travel_times/travel_times.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "docent/base/random.h"

namespace docent::task_control {
namespace {

Time at(double s) { return time_from_seconds(s); }

TEST(TravelTimes, SayWhatTheLengthSaysUntilTheyHaveSeenSomething) {
  TravelTimeParams params;
  params.speed = 0.5;
  params.start_s = 4.0;
  const TravelTimes times{params};
  for (const double way_m : {0.0, 3.0, 30.0})
    EXPECT_NEAR(times.way("a", "b", way_m, {}).mean_s, 4.0 + 2.0 * way_m, 1e-9) << way_m;
  EXPECT_NEAR(times.way("a", "b", 10.0, {}).spread_s, params.spread * 24.0, 1e-9);
  EXPECT_EQ(times.way("a", "b", std::numeric_limits<double>::infinity(), {}).mean_s,
            std::numeric_limits<double>::infinity());
  EXPECT_EQ(times.beyond_speech(VisitCourse::went_on), params.question_s);
  EXPECT_EQ(times.share_of_more(), params.more_share);
}

// Ways at 0.25 m/s with 6 s to set out, a pair that takes twice as long, and a spread of 20 %.
TEST(TravelTimes, LearnSpeedPairsAndSpread) {
  TravelTimes times{TravelTimeParams{}};
  Rng rng{3};
  for (int i = 0; i < 600; ++i) {
    const bool is_slow_pair = i % 6 == 0;
    const double way_m = is_slow_pair ? 10.0 : rng.uniform(2.0, 25.0);
    const double true_s = (6.0 + 4.0 * way_m) * (is_slow_pair ? 2.0 : 1.0);
    times.learn_way(is_slow_pair ? "a" : "", is_slow_pair ? "b" : "", way_m,
                    true_s * std::max(0.2, rng.normal(1.0, 0.2)), at(100.0 * i));
  }
  const Time later = at(1e6);  // nothing is known of the crowd
  const Foreseen slow = times.way("a", "b", 10.0, later);
  EXPECT_NEAR(slow.mean_s, 92.0, 6.0);
  EXPECT_NEAR(slow.spread_s, 18.4, 5.0);
  EXPECT_GT(times.way("c", "d", 20.0, later).mean_s, 1.5 * times.way("c", "d", 10.0, later).mean_s);
  const auto table = travel_table(times.rows());
  ASSERT_EQ(table.size(), 1U);
  EXPECT_EQ(table.front().examples, 100);
  EXPECT_NEAR(table.front().mean_s, 92.0, 5.0);
  EXPECT_EQ(table.front().way_m, 10.0);
}

TEST(TravelTimes, OneBlockedWayDoesNotSpoilAPair) {
  TravelTimes times{TravelTimeParams{}};
  for (int i = 0; i < 20; ++i) times.learn_way("a", "b", 7.0, 23.0, at(60.0 * i));
  const double before_s = times.way("a", "b", 7.0, at(1e6)).mean_s;
  EXPECT_NEAR(before_s, 23.0, 1.0);
  times.learn_way("a", "b", 7.0, 600.0, at(1300.0));
  EXPECT_LT(times.way("a", "b", 7.0, at(1e6)).mean_s, before_s + 3.5);
}

TEST(TravelTimes, ForeseeTheCrowdOfTheLastHalfHour) {
  TravelTimes times{TravelTimeParams{}};
  for (int i = 0; i < 200; ++i) times.learn_way("a", "b", 7.0, 20.0, at(60.0 * i));
  for (int i = 0; i < 6; ++i) times.learn_way("c", "d", 7.0, 40.0, at(12000.0 + 60.0 * i));
  EXPECT_GT(times.way("a", "b", 7.0, at(12400.0)).mean_s, 22.0) << "people are in the way everywhere";
  EXPECT_NEAR(times.way("a", "b", 7.0, at(12400.0 + 7200.0)).mean_s, 20.0, 1.0) << "two hours later nobody knows";
}

TEST(TravelTimes, KnowTheHoursOfTheDay) {
  TravelTimes times{TravelTimeParams{}};
  for (int day = 0; day < 10; ++day) {
    for (const int hour : {9, 15}) {
      times.set_hour(hour);
      for (int i = 0; i < 12; ++i)
        times.learn_way("a", "b", 7.0, hour == 9 ? 18.0 : 27.0, at(86400.0 * day + 3600.0 * hour + 300.0 * i));
    }
  }
  times.set_hour(9);
  const double morning_s = times.way("a", "b", 7.0, at(1e7)).mean_s;
  times.set_hour(15);
  const double afternoon_s = times.way("a", "b", 7.0, at(1e7)).mean_s;
  EXPECT_NEAR(morning_s, 18.0, 2.5);
  EXPECT_NEAR(afternoon_s, 27.0, 2.5);
}

TEST(TravelTimes, AnExhibitThatWasMovedIsLearnedAnew) {
  TravelTimes times{TravelTimeParams{}};
  for (int i = 0; i < 50; ++i) times.learn_way("a", "b", 7.0, 60.0, at(i));
  const double by_length_s = times.way("x", "y", 20.0, at(1e6)).mean_s;
  EXPECT_DOUBLE_EQ(times.way("a", "b", 20.0, at(1e6)).mean_s, by_length_s);
  times.learn_way("a", "b", 20.0, 50.0, at(100.0));
  ASSERT_EQ(travel_table(times.rows()).front().examples, 1);
}

TEST(TravelTimes, LearnWhatVisitsTakeBeyondTheirWords) {
  TravelTimes times{TravelTimeParams{}};
  for (int i = 0; i < 200; ++i) times.learn_visit(i % 4 == 0 ? VisitCourse::heard_more : VisitCourse::went_on, 4.2);
  EXPECT_NEAR(times.beyond_speech(VisitCourse::went_on), 4.2, 0.1);
  EXPECT_NEAR(times.share_of_more(), 0.25, 0.01);
  times.learn_visit(VisitCourse::unasked, 1e4);
  EXPECT_LT(times.beyond_speech(VisitCourse::unasked), 6.0);
}

TEST(TravelTimes, SurviveARestartBitForBit) {
  TravelTimes times{TravelTimeParams{}};
  Rng rng{8};
  for (int i = 0; i < 100; ++i) {
    const std::string from = "e" + std::to_string(rng.integer(0, 5));
    const std::string to = "e" + std::to_string(rng.integer(0, 5));
    times.learn_way(from, to, 5.0, rng.uniform(10.0, 40.0), at(60.0 * i));
    times.learn_visit(VisitCourse::unasked, rng.uniform(0.0, 3.0));
  }
  TravelTimes again{TravelTimeParams{}};
  again.restore(times.rows());
  EXPECT_EQ(again.way("e1", "e2", 5.0, at(6100.0)).mean_s, times.way("e1", "e2", 5.0, at(6100.0)).mean_s);
  EXPECT_EQ(again.beyond_speech(VisitCourse::unasked), times.beyond_speech(VisitCourse::unasked));
  EXPECT_TRUE(again.unstored().empty());
  EXPECT_EQ(times.unstored().size(), times.rows().size());
  const std::vector<LessonRow> damaged{{{LessonKind::pair, "a", "b"}, {std::nan(""), 1.0, 1.0, 5.0}}};
  again.restore(damaged);
  EXPECT_TRUE(std::isfinite(again.way("a", "b", 5.0, {}).mean_s));
}

TEST(TravelTimes, LearnNothingWhereTheyAreNotTo) {
  TravelTimeParams params;
  params.learns = false;
  TravelTimes times{params};
  const double before_s = times.way("a", "b", 7.0, {}).mean_s;
  for (int i = 0; i < 50; ++i) times.learn_way("a", "b", 7.0, 100.0, at(i));
  times.learn_visit(VisitCourse::unasked, 9.0);
  EXPECT_EQ(times.way("a", "b", 7.0, at(60.0)).mean_s, before_s);
  EXPECT_TRUE(times.rows().empty());
}

TEST(TravelTimes, AreWrittenAsATable) {
  TravelTimes times{TravelTimeParams{}};
  times.learn_way("zuse", "airbus/3", 12.5, 40.0, {});
  times.learn_way("zuse", "airbus/3", 12.5, 44.0, {});
  times.learn_way("", "mp3", 12.5, 44.0, {});
  EXPECT_EQ(to_csv(travel_table(times.rows())),
            "from,to,examples,mean_s,spread_s,way_m\nzuse,airbus/3,2,42.00,2.83,12.50\n");
}

TEST(TravelTimes, EveryKindHasItsWord) {
  for (int i = 0; i <= static_cast<int>(LessonKind::demand); ++i) {
    const auto kind = static_cast<LessonKind>(i);
    EXPECT_EQ(lesson_kind_of(to_text(kind)), kind);
  }
  EXPECT_FALSE(lesson_kind_of("weather"));
}

}  // namespace
}  // namespace docent::task_control
