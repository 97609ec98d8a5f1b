#include "docent/task_control/tour_scheduler/scheduling_fixture.h"

// Points on the map, rooms, and tours for which the Web's visitors voted ([Minerva2000] 6.4).

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
  EXPECT_EQ(point_name({{-0.001, -2.0}}), "0.00,-2.00");
  EXPECT_EQ(point_name(*point_of("3,4.5,1.5708")), "3.00,4.50,1.57");
  EXPECT_EQ(point_name(*point_of("3,4.5,-0.001")), "3.00,4.50,0.00");
  for (const char* text : {"", "3", "3,", ",4", "3,4,", "3,4,5,6", "3,4,5 ", "3,4,x", "3,4,nan", "3,4,1e9", "3,4 ",
                           "x,4", "nan,1", "inf,1", "20000,1"})
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

TEST_F(Points, TakeTheHeadingThatIsWishedFor) {
  wish("p", RequestKind::point, "3,4,1.57", 0);
  EXPECT_EQ(next(1), "3.00,4.00,1.57");
  EXPECT_NEAR(scheduler.state().visit->map_from_base.theta.radians(), 1.57, 1e-9);
  finish(true, 9);
  EXPECT_EQ(state_of("p"), "fulfilled");
  wish("q", RequestKind::point, "3,4", 10);
  next(11);
  EXPECT_NEAR(scheduler.state().visit->map_from_base.theta.radians(), std::atan2(4.0, 3.0), 1e-9)
      << "without one it stays as it comes";
}

TEST_F(Points, OfTheStaffComeFirst) {
  wish("visitor", RequestKind::point, "1,0", 0);
  scheduler.submit({"fleet", {}, RequestSource::staff, "", RequestKind::point, "9,0,0", -1, "en"}, conditions,
                   time_from_seconds(1));
  EXPECT_EQ(next(2), "9.00,0.00,0.00");
  finish(true, 9);
  EXPECT_EQ(next(10), "1.00,0.00");
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

/// Three rooms beside one another, 10 m wide each: "a" from 0, "b" from 10, "c" from 20; the robot goes to their
/// middles.
class RoomWishes : public Scheduling {
 protected:
  RoomWishes() {
    rooms.rooms = {{"a", {5.0, 2.0}}, {"b", {15.0, 2.0}}, {"c", {25.0, 2.0}}};
    rooms.room_at = [](Point2 point) {
      return point.x < 0.0 || point.x >= 30.0 ? -1 : static_cast<int>(point.x / 10.0);
    };
    auto programme = programme_on_a_line();
    programme.rooms = [this]() -> const Rooms& { return rooms; };
    scheduler = TourScheduler{params, programme, straight_distance(), {}, {}};
  }
  void wish_for_room(const std::string& id, const std::string& target, double at,
                     RequestSource source = RequestSource::staff) {
    scheduler.submit({id, time_from_seconds(at), source, "", RequestKind::room, target, -1, "en"}, conditions,
                     time_from_seconds(at));
  }
  [[nodiscard]] const BoardEntry& entry(const std::string& id) const { return *scheduler.state().board.find(id); }
  Rooms rooms;
};

TEST_F(RoomWishes, AreServedLikePoints) {
  wish_for_room("r", "c", 0);
  ASSERT_EQ(next(1), "c");
  EXPECT_EQ(scheduler.state().visit->task_kind(), TaskKind::point);
  EXPECT_EQ(scheduler.state().visit->map_from_base.position(), (Point2{25.0, 2.0}));
  finish(true, 30);
  EXPECT_EQ(state_of("r"), "fulfilled");
  EXPECT_EQ(scheduler.programme().exhibits.size(), 6U) << "it is forgotten with its request";
}

TEST_F(RoomWishes, TheNextIsTheOneAfterWhereTheRobotIs) {
  conditions.robot = {12.0, 0.0};
  wish_for_room("r", "next", 0);
  EXPECT_EQ(entry("r").request.target, "c");
  wish_for_room("again", "next", 1);
  EXPECT_EQ(entry("again").request.target, "a") << "after the one for which somebody waits";
  EXPECT_EQ(next(2), "c");
  finish(true, 10);
  EXPECT_EQ(next(11), "a");
  finish(true, 20);
  conditions.robot = {-5.0, 0.0};
  wish_for_room("lost", "next", 30);
  EXPECT_EQ(entry("lost").request.target, "a") << "from nowhere to the first";
}

TEST_F(RoomWishes, WhoMay) {
  wish_for_room("web", "b", 0, RequestSource::web);
  EXPECT_EQ(entry("web").reason.text(), "only_in_web_hours");
  wish_for_room("kiosk", "b", 0, RequestSource::kiosk);
  EXPECT_EQ(entry("kiosk").status, RequestStatus::queued) << "whoever stands beside the robot goes with it";
  conditions.mode = OperatingMode::web;
  wish_for_room("late", "b", 0, RequestSource::web);
  EXPECT_EQ(entry("late").status, RequestStatus::queued);
}

TEST_F(RoomWishes, ThatNobodyCanServe) {
  wish_for_room("r", "attic", 0);
  EXPECT_EQ(entry("r").reason.text(), "no_such_room attic");
  rooms.rooms.resize(1);
  rooms.room_at = [](Point2) { return 0; };
  wish_for_room("only", "next", 0);
  EXPECT_EQ(entry("only").reason.text(), "no_such_room next") << "there is no other";
  conditions.takes_points = false;
  wish_for_room("golog", "a", 0);
  EXPECT_EQ(entry("golog").status, RequestStatus::refused);
  TourScheduler without{params, programme_on_a_line(), straight_distance(), {}, {}};
  conditions.takes_points = true;
  without.submit({"x", {}, RequestSource::staff, "", RequestKind::room, "a", -1, "en"}, conditions, {});
  EXPECT_EQ(without.state().board.find("x")->reason.text(), "no_such_room a");
}

TEST_F(RoomWishes, GoOnAfterARestart) {
  wish_for_room("r", "b", 0);
  wish_for_room("s", "c", 1);
  ASSERT_EQ(next(2), "b");
  auto programme = programme_on_a_line();
  programme.rooms = [this]() -> const Rooms& { return rooms; };
  rooms.rooms.pop_back();
  TourScheduler again{params, programme, straight_distance(), scheduler.state(), time_from_seconds(3)};
  ASSERT_TRUE(again.state().visit);
  EXPECT_EQ(again.state().visit->exhibit_id, "b");
  EXPECT_EQ(again.state().board.find("s")->reason.text(), "gone") << "another map, another room";
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
