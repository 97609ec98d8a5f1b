#include "docent/task_control/tour_scheduler/scheduling_fixture.h"

// Points on the map, and tours for which the Web's visitors voted ([Minerva2000] 6.4).

namespace docent::task_control {
namespace {

class Points : public Scheduling {
 protected:
  Points() { conditions.mode = OperatingMode::web; }
  [[nodiscard]] std::string reason_of(const std::string& id) const {
    return scheduler.state().board.find(id)->reason.text();
  }
};

TEST(PointName, IsTheSameForTheSamePlace) {
  EXPECT_EQ(point_name(*point_of("3,4.5")), "3.00,4.50");
  EXPECT_EQ(point_name(*point_of("3.001,4.499")), "3.00,4.50");
  EXPECT_EQ(point_name({-0.001, -2.0}), "0.00,-2.00");
  for (const char* text : {"", "3", "3,", ",4", "3,4,5", "3,4 ", "x,4", "nan,1", "inf,1", "20000,1"})
    EXPECT_FALSE(point_of(text)) << text;
}

TEST_F(Points, AreApproachedInTheOrderReceived) {
  wish("far", RequestKind::point, "30,0", 0);
  wish("near", RequestKind::point, "1,0", 1);
  wish("middle", RequestKind::point, "9,0", 2);
  EXPECT_EQ(serve_all(10), (std::vector<std::string>{"30.00,0.00", "1.00,0.00", "9.00,0.00"}));
  EXPECT_EQ(state_of("far"), "fulfilled");
  EXPECT_EQ(scheduler.state().counters.exhibits_explained, 0U);
  EXPECT_EQ(scheduler.state().counters.requests_served, 3U);
  // The points are forgotten with their requests.
  EXPECT_EQ(scheduler.programme().exhibits.size(), 6U);
}

TEST_F(Points, TheSixthIsRefusedUntilOneWasReached) {
  for (int i = 0; i < 5; ++i) wish("p" + std::to_string(i), RequestKind::point, std::to_string(i) + ",2", i);
  wish("sixth", RequestKind::point, "9,2", 6);
  EXPECT_EQ(state_of("sixth"), "refused");
  EXPECT_EQ(reason_of("sixth"), "too_many_points");
  wish("same", RequestKind::point, "4.00,2.0", 7);  // no point more than there are
  EXPECT_EQ(state_of("same"), "queued");
  EXPECT_EQ(next(8), "0.00,2.00");
  finish(true, 20);
  wish("seventh", RequestKind::point, "9,2", 21);
  EXPECT_EQ(state_of("seventh"), "queued");
}

TEST_F(Points, OnlyInTheHoursOfTheWeb) {
  conditions.mode = OperatingMode::open;
  wish("p", RequestKind::point, "3,3", 0);
  EXPECT_EQ(reason_of("p"), "only_in_web_hours");
  scheduler.submit({"operator", {}, RequestSource::staff, "", RequestKind::point, "3,3", -1, "en"}, conditions, {});
  EXPECT_EQ(state_of("operator"), "queued");
}

TEST_F(Points, WhereTheRobotCannotGetTo) {
  TourScheduler walled{params,
                       programme_on_a_line(),
                       [](Point2, Point2 to) { return to.y > 5.0 ? std::numeric_limits<double>::infinity() : 1.0; },
                       {},
                       {}};
  walled.submit({"p", {}, RequestSource::web, "", RequestKind::point, "3,6", -1, "en"}, conditions, {});
  EXPECT_EQ(walled.state().board.find("p")->reason.text(), "not_on_free_floor");
  auto programme = programme_on_a_line();
  programme.has_room = [](Point2 place) { return place.x < 5.0; };
  TourScheduler narrow{params, programme, straight_distance(), {}, {}};
  narrow.submit({"p", {}, RequestSource::web, "", RequestKind::point, "6,1", -1, "en"}, conditions, {});
  EXPECT_EQ(narrow.state().board.find("p")->reason.text(), "not_on_free_floor");
  narrow.submit({"r", {}, RequestSource::web, "", RequestKind::point, "4,1", -1, "en"}, conditions, {});
  EXPECT_EQ(narrow.state().board.find("r")->status, RequestStatus::queued);
  walled.submit({"q", {}, RequestSource::web, "", RequestKind::point, "3;6", -1, "en"}, conditions, {});
  EXPECT_EQ(walled.state().board.find("q")->status, RequestStatus::refused);
}

TEST_F(Points, HaveTheirTurnAmongExhibitsByTheirAge) {
  wish("e", RequestKind::exhibit, "e3", 0);
  wish("p", RequestKind::point, "1,0", 1);
  wish("f", RequestKind::exhibit, "e1", 2);
  // The exhibits by the least travel while one of them is the oldest wish.
  EXPECT_EQ(next(10), "e1");
  finish(true, 20);
  EXPECT_EQ(next(20, {4, 0}), "e3");
  finish(true, 30);
  EXPECT_EQ(next(30, {12, 0}), "1.00,0.00");
}

TEST_F(Points, AreNoStopsOfComposedTours) {
  wish("p", RequestKind::point, "1,0", 0);
  scheduler.submit({"t", {}, RequestSource::web, "", RequestKind::tour, "quick", -1, "en"}, conditions, {});
  EXPECT_EQ(next(1), "1.00,0.00");
  finish(true, 10);
  for (const std::string& exhibit : serve_all(10)) EXPECT_EQ(exhibit.front(), 'e');
}

TEST_F(Points, GoOnAfterARestart) {
  wish("p", RequestKind::point, "1,7", 0);
  ASSERT_EQ(next(1), "1.00,7.00");
  const Pose2 pose = scheduler.state().visit->map_from_base;
  EXPECT_NEAR(pose.theta.radians(), std::atan2(7.0, 1.0), 1e-9);  // it looks where it came to
  TourScheduler again{params, programme_on_a_line(), straight_distance(), scheduler.state(), time_from_seconds(2)};
  ASSERT_TRUE(again.state().visit);
  EXPECT_TRUE(is_same(again.state().visit->map_from_base, pose));
  again.finish_visit(true, {}, time_from_seconds(9));
  EXPECT_EQ(again.state().board.find("p")->status, RequestStatus::fulfilled);
}

TEST_F(Points, ACancelledOneIsNotWantedAnyMore) {
  wish("p", RequestKind::point, "1,7", 0);
  ASSERT_EQ(next(1), "1.00,7.00");
  wish("c", RequestKind::cancel, "p", 2);
  EXPECT_TRUE(scheduler.is_visit_unwanted());
  scheduler.drop_visit(time_from_seconds(3));
  EXPECT_EQ(next(4), "");
}

TEST_F(Scheduling, ATourThatWasVotedForIsTheNext) {
  wish("first", RequestKind::tour, "t", 0);
  scheduler.submit({"round", {}, RequestSource::vote, "", RequestKind::tour, "two", -1, "en"}, conditions,
                   time_from_seconds(2));
  EXPECT_EQ(next(3), "e2");
  EXPECT_EQ(scheduler.state().tour->tour_id, "two");
  EXPECT_EQ(scheduler.state().counters.tours_since_vote, 0U);
  serve_all_from_here(4);
  EXPECT_EQ(state_of("round"), "fulfilled");
  EXPECT_EQ(state_of("first"), "fulfilled");
  EXPECT_EQ(scheduler.state().counters.tours_since_vote, 1U);
}

}  // namespace
}  // namespace docent::task_control
