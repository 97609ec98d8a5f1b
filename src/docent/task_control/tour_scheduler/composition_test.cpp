#include "docent/task_control/tour_scheduler/composition.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "docent/task_control/tour_scheduler/scheduling_fixture.h"

namespace docent::task_control {
namespace {

TEST(Composition, FillsTheTimeWithWhatIsNear) {
  const Programme programme = programme_on_a_line();
  SchedulerParams params;
  params.cruise_speed = 0.4;
  params.stop_overhead_s = 10.0;  // each stop: 10 s drive + 20 s speech + 10 s
  const auto compose = [&](double left_s, const std::vector<std::string>& done) {
    return compose_tour(programme, {0, 0}, left_s, {done, {}}, straight_distance(), params);
  };
  EXPECT_EQ(compose(120.0, {}), (std::vector<std::string>{"e1", "e2", "e3"}));
  EXPECT_EQ(compose(139.0, {}).size(), 3U);
  EXPECT_EQ(compose(141.0, {}).size(), 4U) << "more than half of it still fits";
  EXPECT_EQ(compose(60.0, {"e1"}), std::vector<std::string>{"e2"});
  EXPECT_TRUE(compose(-5.0, {}).empty());
  EXPECT_EQ(compose(1e6, {}).size(), 5U) << "all but the Web's own";
}

TEST(Composition, PrefersWhatMakesSenseAfterTheExhibitBefore) {
  Programme programme = programme_on_a_line();
  const auto first = [&](const std::string& after) {
    return compose_tour(programme, {8, 0}, 1e6, {{"e2"}, {}, after}, straight_distance(), {}).front();
  };
  EXPECT_EQ(first("e2"), "e1") << "as near as e3, and listed first";
  programme.exhibits[1].next = {"e4"};
  EXPECT_EQ(first(""), "e1");
  programme.exhibits[1].next = {"e3", "e5"};
  EXPECT_EQ(first("e2"), "e3");
  EXPECT_EQ(first(""), "e1") << "nothing was shown before";
}

using ComposedTour = Scheduling;

TEST_F(ComposedTour, AComposedTourIsFittedToTheTimeOnTheWay) {
  for (const double delay_s : {0.0, 40.0, 100.0}) {  // on top of what was foreseen, at the first stop
    TourScheduler tour{params, programme_on_a_line(), straight_distance(), {}, {}};
    tour.submit({"a", {}, RequestSource::web, "", RequestKind::tour, "quick", -1, "en"}, conditions, {});
    double at = 0.0;
    Point2 robot{0, 0};
    int stops = 0;
    while (const auto visit = tour.begin_visit(robot, time_from_seconds(at))) {
      const auto& exhibit = *tour.programme().find_exhibit(visit->exhibit_id);
      at += stop_duration(exhibit, distance(robot, exhibit.pose.position()), params) + (stops == 0 ? delay_s : 0.0);
      robot = exhibit.pose.position();
      tour.finish_visit(true, "", time_from_seconds(at));
      ++stops;
    }
    EXPECT_EQ(tour.state().board.find("a")->status, RequestStatus::fulfilled);
    EXPECT_NEAR(at, std::max(120.0, 46.0 + delay_s), 24.0) << delay_s;
    EXPECT_EQ(stops, delay_s == 0.0 ? 3 : delay_s == 40.0 ? 2 : 1);
  }
}

TEST_F(ComposedTour, AComposedTourShowsWhatOthersWishFor) {
  wish("a", RequestKind::tour, "quick", 0);
  wish("b", RequestKind::exhibit, "e3", 0);
  EXPECT_EQ(next(0), "e3");
  finish(true, 70);
  EXPECT_EQ(state_of("b"), "fulfilled");
  EXPECT_EQ(next(71, {12, 0}), "e2");
}

TEST_F(ComposedTour, AComposedTourShowsSomethingElseInstead) {
  wish("a", RequestKind::tour, "quick", 0);
  EXPECT_EQ(next(0), "e1");
  finish(false, 10);
  EXPECT_EQ(next(10), "e2");
  finish(true, 50);
  EXPECT_EQ(next(50, {8, 0}), "e3");
  finish(true, 115);
  EXPECT_EQ(next(116, {12, 0}), "");
  EXPECT_EQ(state_of("a"), "fulfilled");
}

TEST_F(ComposedTour, AComposedTourIsJoinedBeforeItsFirstWordOnly) {
  wish("a", RequestKind::tour, "quick", 0);
  wish("near", RequestKind::exhibit, "e1", 0);
  EXPECT_EQ(next(1), "e1");
  wish("b", RequestKind::tour, "quick", 2);
  EXPECT_EQ(state_of("b"), "active");
  scheduler.close_visit();
  wish("c", RequestKind::tour, "quick", 3);
  EXPECT_EQ(state_of("c"), "queued");
}

}  // namespace
}  // namespace docent::task_control
