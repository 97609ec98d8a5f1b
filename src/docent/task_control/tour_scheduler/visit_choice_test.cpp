#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "docent/task_control/tour_scheduler/scheduling_fixture.h"

namespace docent::task_control {
namespace {

/// What the scheduler said of its order since the last call.
std::vector<std::string> orders_of(TourScheduler& scheduler) {
  std::vector<std::string> orders;
  for (const Happening& happening : scheduler.take_happenings()) {
    if (happening.kind == EventKind::order_chosen) orders.push_back(happening.subject + ": " + happening.detail);
  }
  return orders;
}

TEST_F(Scheduling, TellsTheOrderOfEachChoiceOfSingleExhibits) {
  wish("a", RequestKind::exhibit, "e3", 0);
  wish("b", RequestKind::exhibit, "e2", 0, "en", 1);
  EXPECT_EQ(next(1), "e2");
  EXPECT_EQ(orders_of(scheduler), std::vector<std::string>{"e2: e2/1 e3"});
  finish(true, 30);
  EXPECT_EQ(next(30, {8, -1}), "e3");
  EXPECT_EQ(orders_of(scheduler), std::vector<std::string>{"e3: e3"});
  finish(true, 60);
  wish("tour", RequestKind::tour, "t", 70);
  EXPECT_EQ(next(71), "e1");
  EXPECT_EQ(orders_of(scheduler), std::vector<std::string>{}) << "a tour has its own order";
}

TEST_F(Scheduling, OverdueOnesComeFirstByTheLeastTravel) {
  for (const char* exhibit : {"e5", "e2", "e4"}) wish(exhibit, RequestKind::exhibit, exhibit, 0);
  const double late = params.overdue_s + 1.0;
  wish("new", RequestKind::exhibit, "e1", late);
  EXPECT_EQ(scheduler.agenda({0, 0}, time_from_seconds(late)), (std::vector<std::string>{"e2", "e4", "e5", "e1"}));
}

TEST_F(Scheduling, WhereManyWaitNobodyIsOverdueOnlyForThat) {
  params.overdue_per_stop_s = 300.0;
  scheduler = TourScheduler{params, programme_on_a_line(), straight_distance(), {}, {}};
  for (const char* exhibit : {"e5", "e4", "e3"}) wish(exhibit, RequestKind::exhibit, exhibit, 0);
  for (const auto& [at, first] : {std::pair{800.0, "e1"}, std::pair{1300.0, "e3"}}) {
    wish("new", RequestKind::exhibit, "e1", at);
    EXPECT_EQ(scheduler.agenda({0, 0}, time_from_seconds(at)).front(), first) << "four stops, 1200 s; after " << at;
  }
}

TEST_F(Scheduling, WhoCameAmongManyIsNotOverdueWhenFewAreLeft) {
  params.overdue_per_stop_s = 300.0;
  scheduler = TourScheduler{params, programme_on_a_line(), straight_distance(), {}, {}};
  for (const char* exhibit : {"e2", "e3", "e4", "e5"}) wish(exhibit, RequestKind::exhibit, exhibit, 0);
  for (const char* exhibit : {"e2", "e3"}) {
    EXPECT_EQ(next(10, {4, 0}), exhibit);
    finish(true, 60);
  }
  wish("new", RequestKind::exhibit, "e1", 700);
  const auto first_of = [&](double at) { return scheduler.agenda({4, 0}, time_from_seconds(at)).front(); };
  EXPECT_EQ(first_of(1100), "e1") << "three stops now, but four were wished for at once: 1200 s";
  EXPECT_EQ(first_of(1300), "e4");
  TourScheduler again{params, programme_on_a_line(), straight_distance(), scheduler.state(), time_from_seconds(1100)};
  EXPECT_EQ(again.agenda({4, 0}, time_from_seconds(1100)).front(), "e1") << "also after a restart";
}

TEST_F(Scheduling, CrippledItServesInTheOrderOfArrival) {
  params.by_travel = false;
  scheduler = TourScheduler{params, programme_on_a_line(), straight_distance(), {}, {}};
  for (const char* exhibit : {"e5", "e1", "e3"}) wish(exhibit, RequestKind::exhibit, exhibit, 0);
  EXPECT_EQ(serve_all(1), (std::vector<std::string>{"e5", "e1", "e3"}));
}

}  // namespace
}  // namespace docent::task_control
