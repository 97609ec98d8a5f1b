#include <algorithm>

#include "docent/task_control/tour_scheduler/scheduling_fixture.h"

namespace docent::task_control {
namespace {

class DecliningStops : public Scheduling {
 protected:
  void tour(const std::string& id, RequestSource source, const std::string& target = "t") {
    scheduler.submit({id, {}, source, "", RequestKind::tour, target, -1, "en"}, conditions, time_from_seconds(now));
  }
  bool decline(const std::string& exhibit, RequestSource source = RequestSource::kiosk) {
    return scheduler.decline_stop({"s" + exhibit, {}, source, "", RequestKind::skip, exhibit, -1, "en"},
                                  time_from_seconds(now += 1.0));
  }
  int count(EventKind kind) {
    for (Happening& happening : scheduler.take_happenings()) happenings.push_back(std::move(happening));
    return static_cast<int>(
        std::count_if(happenings.begin(), happenings.end(), [&](const auto& one) { return one.kind == kind; }));
  }
  double now = 0.0;
  std::vector<Happening> happenings;
};

TEST_F(DecliningStops, TheTourGoesOnAtTheNextStopAndIsFulfilled) {
  tour("a", RequestSource::kiosk);
  EXPECT_EQ(next(1), "e1");
  EXPECT_TRUE(decline("e1"));
  EXPECT_FALSE(scheduler.state().visit);
  EXPECT_FALSE(decline("e1")) << "said twice is said once";
  EXPECT_EQ(next(3), "e3");
  scheduler.close_visit();  // it explains: that ends, too
  EXPECT_TRUE(decline("e3"));
  EXPECT_EQ(next(5), "e5");
  finish(true, 60);
  EXPECT_EQ(state_of("a"), "fulfilled") << "what they did not want is not missed";
  EXPECT_TRUE(scheduler.state().board.find("a")->reason.is_none());
  EXPECT_EQ(count(EventKind::tour_completed), 1);
  EXPECT_EQ(count(EventKind::plan_removed), 2);
  EXPECT_EQ(scheduler.state().counters.exhibits_explained, 1U);
}

TEST_F(DecliningStops, WhoDeclinesEverythingHasCalledTheTourOff) {
  tour("a", RequestSource::kiosk);
  for (const char* exhibit : {"e1", "e3", "e5"}) {
    EXPECT_EQ(next(now + 1), exhibit);
    EXPECT_TRUE(decline(exhibit));
  }
  EXPECT_EQ(state_of("a"), "cancelled");
  EXPECT_FALSE(scheduler.state().tour || scheduler.state().farewell);
  EXPECT_EQ(count(EventKind::tour_failed), 0);
}

TEST_F(DecliningStops, OnlyTheirOwnTourAndOnlyTheStopUnderWay) {
  tour("web", RequestSource::web);
  EXPECT_FALSE(decline("e1")) << "nothing is under way";
  EXPECT_EQ(next(1), "e1");
  EXPECT_FALSE(decline("e1")) << "nobody before the robot takes part";
  EXPECT_FALSE(decline("e1", RequestSource::web));
  EXPECT_FALSE(decline("e3", RequestSource::staff)) << "a press that came late";
  EXPECT_TRUE(decline("e1", RequestSource::staff));
  wish("single", RequestKind::exhibit, "e3", now);
  EXPECT_EQ(next(3), "e3");
}

TEST_F(DecliningStops, OthersOfTheSameTourAreShownItAtTheEnd) {
  tour("web", RequestSource::web);
  tour("kiosk", RequestSource::kiosk);
  EXPECT_EQ(next(1), "e1");
  EXPECT_TRUE(decline("e1"));
  EXPECT_EQ(next(3), "e3");
  finish(true, 60);
  EXPECT_EQ(next(61), "e5");
  finish(true, 120);
  EXPECT_EQ(state_of("kiosk"), "fulfilled");
  EXPECT_EQ(state_of("web"), "active");
  EXPECT_EQ(next(121), "e1");
  finish(true, 180);
  EXPECT_EQ(state_of("web"), "fulfilled");
}

TEST_F(DecliningStops, AllOfTheirsDeclinedWhileOthersGoOn) {
  tour("web", RequestSource::web);
  tour("kiosk", RequestSource::kiosk);
  for (const char* exhibit : {"e1", "e3", "e5"}) {
    EXPECT_EQ(next(now + 1), exhibit);
    EXPECT_TRUE(decline(exhibit));
  }
  EXPECT_EQ(state_of("kiosk"), "cancelled");
  EXPECT_EQ(serve_all(now), (std::vector<std::string>{"e1", "e3", "e5"}));
  EXPECT_EQ(state_of("web"), "fulfilled");
}

TEST_F(DecliningStops, WhoWishedForTheExhibitAloneWaitsAgain) {
  tour("a", RequestSource::kiosk);
  wish("single", RequestKind::exhibit, "e1", 0);
  EXPECT_EQ(next(1), "e1");
  EXPECT_EQ(state_of("single"), "active");
  EXPECT_TRUE(decline("e1"));
  EXPECT_EQ(state_of("single"), "queued");
  EXPECT_EQ(next(3, {4, 0}), "e3") << "not the exhibit that they have just left";
  finish(true, 60);
  serve_all(61);
  EXPECT_EQ(state_of("single"), "fulfilled");
  EXPECT_EQ(state_of("a"), "fulfilled");
}

TEST_F(DecliningStops, AComposedTourShowsSomethingElse) {
  tour("a", RequestSource::kiosk, "quick");
  const std::string first = next(1);
  ASSERT_NE(first, "");
  EXPECT_TRUE(decline(first));
  const std::string second = next(3);
  EXPECT_NE(second, "");
  EXPECT_NE(second, first);
  for (const TourStop& stop : scheduler.state().tour->stops)
    EXPECT_TRUE(stop.exhibit_id != first || stop.status == StopStatus::declined);
}

}  // namespace
}  // namespace docent::task_control
