#include <gtest/gtest.h>

#include "docent/task_control/tour_scheduler/scheduling_fixture.h"

namespace docent::task_control {
namespace {

/// The tour t shows e1, e3 and e5; somebody in the hall wishes for it, and it is broken off before e3.
class BrokenTour : public Scheduling {
 protected:
  void break_off_after_first(RequestSource source) {
    submit("a", source, 0.0);
    EXPECT_EQ(begin(0.0), "e1");
    scheduler.finish_visit(true, {}, time_from_seconds(60));
    EXPECT_EQ(begin(60.0), "e3");
    scheduler.break_off(ReasonWord::battery_low, time_from_seconds(70));
    EXPECT_EQ(state_of("a"), "queued");
  }
  void submit(const std::string& id, RequestSource source, double at) {
    scheduler.submit({id, {}, source, "", RequestKind::tour, "t", -1, "en"}, conditions, time_from_seconds(at));
  }
  std::string begin(double at) {
    const auto& visit = scheduler.begin_visit({0, 0}, time_from_seconds(at));
    return visit ? visit->exhibit_id : "";
  }
};

TEST_F(BrokenTour, GoesOnWhereItStood) {
  break_off_after_first(RequestSource::kiosk);
  EXPECT_EQ(scheduler.agenda({0, 0}, time_from_seconds(80)), (std::vector<std::string>{"e3", "e5"}));
  EXPECT_EQ(scheduler.choices({0, 0}, time_from_seconds(80)), std::vector<std::string>{"e3"});
  EXPECT_EQ(begin(600.0), "e3");
  scheduler.finish_visit(true, {}, time_from_seconds(660));
  EXPECT_EQ(begin(660.0), "e5");
  scheduler.finish_visit(true, {}, time_from_seconds(720));
  EXPECT_EQ(state_of("a"), "fulfilled");
  EXPECT_EQ(scheduler.state().counters.exhibits_explained, 3U);
  EXPECT_EQ(scheduler.state().counters.tours_completed, 1U);
}

TEST_F(BrokenTour, WhoCameMeanwhileJoinsAndSeesTheirPartAtTheEnd) {
  break_off_after_first(RequestSource::kiosk);
  submit("b", RequestSource::kiosk, 300.0);
  std::vector<std::string> shown;
  for (double at = 600.0; at < 1200.0; at += 60.0) {
    const std::string exhibit = begin(at);
    if (exhibit.empty()) break;
    shown.push_back(exhibit);
    scheduler.finish_visit(true, {}, time_from_seconds(at + 50.0));
  }
  EXPECT_EQ(shown, (std::vector<std::string>{"e3", "e5", "e1"}));
  EXPECT_EQ(state_of("a"), "fulfilled");
  EXPECT_EQ(state_of("b"), "fulfilled");
}

TEST_F(BrokenTour, IsLetGoWhenItsPeopleHaveLeft) {
  break_off_after_first(RequestSource::kiosk);
  scheduler.let_go_broken_tour(time_from_seconds(70.0 + params.wait_for_group_s - 1.0));
  EXPECT_EQ(state_of("a"), "queued") << "they may have taken a step aside";
  scheduler.let_go_broken_tour(time_from_seconds(70.0 + params.wait_for_group_s));
  EXPECT_EQ(state_of("a"), "failed");
  EXPECT_EQ(scheduler.state().board.find("a")->reason, ReasonWord::battery_low);
  EXPECT_EQ(begin(600.0), "");
  submit("b", RequestSource::kiosk, 700.0);
  EXPECT_EQ(begin(700.0), "e1") << "others begin at its beginning";
}

TEST_F(BrokenTour, GoesOnForTheWebWhoeverIsNear) {
  break_off_after_first(RequestSource::web);
  scheduler.let_go_broken_tour(time_from_seconds(3600));
  EXPECT_EQ(begin(3600.0), "e3");
}

TEST_F(BrokenTour, IsForgottenWhenNobodyWaitsForItAnyMore) {
  break_off_after_first(RequestSource::web);
  scheduler.submit({"c", {}, RequestSource::web, "", RequestKind::cancel, "a", -1, "en"}, conditions,
                   time_from_seconds(100));
  submit("b", RequestSource::web, 200.0);
  EXPECT_EQ(begin(200.0), "e1");
  EXPECT_FALSE(scheduler.state().broken_tour);
}

}  // namespace
}  // namespace docent::task_control
