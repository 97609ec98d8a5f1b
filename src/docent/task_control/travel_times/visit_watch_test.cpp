#include "docent/task_control/travel_times/visit_watch.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace docent::task_control {
namespace {

/// The reports of one visit, a status at each time; what was seen in the end.
VisitWatch::Seen seen_in(const std::vector<std::pair<double, TaskStatus>>& reports) {
  VisitWatch watch;
  watch.set_out("a", "b", 5.0, {});
  VisitWatch::Seen all;
  for (const auto& [at, status] : reports) {
    const VisitWatch::Seen seen = watch.report(status, time_from_seconds(at));
    if (seen.way) all.way = seen.way;
    if (seen.visit) all.visit = seen.visit;
  }
  return all;
}

TEST(VisitWatch, TimesTheWayAndTheVisit) {
  const auto plain = seen_in({{1, TaskStatus::driving}, {30, TaskStatus::explaining}, {50, TaskStatus::done}});
  ASSERT_TRUE(plain.way && plain.visit);
  EXPECT_EQ(plain.way->from, "a");
  EXPECT_EQ(plain.way->to, "b");
  EXPECT_NEAR(plain.way->seconds, 30.0, 1e-6);
  EXPECT_EQ(plain.visit->course, VisitCourse::unasked);
  EXPECT_NEAR(plain.visit->seconds, 20.0, 1e-6);
}

TEST(VisitWatch, TellsWhetherVisitorsWantedMore) {
  EXPECT_EQ(seen_in({{9, TaskStatus::explaining}, {20, TaskStatus::asking}, {25, TaskStatus::done}}).visit->course,
            VisitCourse::went_on);
  const auto more = seen_in({{9, TaskStatus::explaining},
                             {20, TaskStatus::asking},
                             {22, TaskStatus::explaining},
                             {40, TaskStatus::explaining},
                             {70, TaskStatus::done}});
  EXPECT_EQ(more.visit->course, VisitCourse::heard_more);
  EXPECT_NEAR(more.visit->seconds, 61.0, 1e-6);
}

TEST(VisitWatch, LearnsNothingFromWhatFailed) {
  EXPECT_FALSE(seen_in({{9, TaskStatus::driving}, {90, TaskStatus::failed}, {91, TaskStatus::done}}).way);
  const auto cut = seen_in({{9, TaskStatus::explaining}, {20, TaskStatus::failed}, {30, TaskStatus::done}});
  EXPECT_TRUE(cut.way);
  EXPECT_FALSE(cut.visit);
  VisitWatch watch;
  EXPECT_FALSE(watch.report(TaskStatus::explaining, {}).way) << "nothing was begun";
  watch.set_out("a", "b", 5.0, {});
  watch.forget();
  EXPECT_FALSE(watch.report(TaskStatus::explaining, {}).way);
}

}  // namespace
}  // namespace docent::task_control
