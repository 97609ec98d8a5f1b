#include "docent/task_control/tour_scheduler/tour_scheduler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <memory>

#include "docent/base/random.h"
#include "docent/task_control/tour_scheduler/scheduling_fixture.h"

namespace docent::task_control {
namespace {

std::vector<VisitorRequest> fulfilled_exhibits(const RequestBoard& board) {
  std::vector<VisitorRequest> requests;
  for (const BoardEntry& entry : board.entries()) {
    if (entry.status == RequestStatus::fulfilled && entry.request.kind == RequestKind::exhibit)
      requests.push_back(entry.request);
  }
  return requests;
}

/// Ends the visit; nothing is called fulfilled that was not shown from where it was wished for.
void finish_and_check(TourScheduler& scheduler, bool is_success, Time now) {
  const Visit visit = *scheduler.state().visit;
  const auto before = fulfilled_exhibits(scheduler.state().board);
  scheduler.finish_visit(is_success, ReasonWord::way_blocked, now);
  for (const VisitorRequest& wish : fulfilled_exhibits(scheduler.state().board)) {
    if (std::any_of(before.begin(), before.end(), [&](const auto& other) { return other.id == wish.id; })) continue;
    EXPECT_TRUE(is_success) << wish.id;
    EXPECT_EQ(wish.target, visit.exhibit_id) << wish.id;
    EXPECT_TRUE(wish.viewpoint < 0 || wish.viewpoint == visit.viewpoint) << wish.id;
  }
}

TEST_F(Scheduling, TakesTheShortestWayThroughTheQueue) {
  for (const char* exhibit : {"e5", "e1", "e3"}) wish(exhibit, RequestKind::exhibit, exhibit, 0);
  EXPECT_EQ(scheduler.agenda({0, 0}, {}), (std::vector<std::string>{"e1", "e3", "e5"}));
  EXPECT_EQ(serve_all(1), (std::vector<std::string>{"e1", "e3", "e5"}));
}

// [Rhino1999] Figs. 21 and 22: 1 and 12 are ordered, 5 comes in while 1 is explained, and is visited before 12.
TEST_F(Scheduling, PlansAnewWhenARequestComesIn) {
  wish("a", RequestKind::exhibit, "e1", 0);
  wish("b", RequestKind::exhibit, "e5", 0);
  EXPECT_EQ(next(1), "e1");
  wish("c", RequestKind::exhibit, "e3", 10);
  finish(true, 30);
  EXPECT_EQ(next(30, {4, 0}), "e3");
}

TEST_F(Scheduling, NobodyStarves) {
  wish("far", RequestKind::exhibit, "e5", 0);
  double at = 0.0;
  int visits = 0;
  while (state_of("far") != "fulfilled" && visits < 100) {  // someone always wishes for what is near
    wish("near" + std::to_string(visits), RequestKind::exhibit, visits % 2 == 0 ? "e1" : "e2", at);
    ASSERT_NE(next(at), "");
    at += 60.0;
    finish(true, at);
    ++visits;
  }
  EXPECT_EQ(state_of("far"), "fulfilled");
  EXPECT_LE(at, params.overdue_s + 180.0);
}

TEST_F(Scheduling, MergesRequestsForOneExhibitAndKeepsTheirStates) {
  wish("a", RequestKind::exhibit, "e2", 0, "de", 1);
  wish("b", RequestKind::exhibit, "e2", 1, "en");
  EXPECT_EQ(next(2), "e2");
  EXPECT_EQ(scheduler.state().visit->language, "de");
  EXPECT_EQ(scheduler.state().visit->map_from_base.y, -1.0);
  wish("c", RequestKind::exhibit, "e2", 3);
  EXPECT_EQ(state_of("c"), "active");
  scheduler.close_visit();
  wish("d", RequestKind::exhibit, "e2", 4);
  EXPECT_EQ(state_of("d"), "queued") << "it would miss the beginning";
  wish("x", RequestKind::cancel, "b", 5);
  finish(true, 30);
  EXPECT_EQ(state_of("a"), "fulfilled");
  EXPECT_EQ(state_of("b"), "cancelled");
  EXPECT_EQ(state_of("c"), "fulfilled");
  EXPECT_EQ(scheduler.state().counters.requests_served, 2U);
  EXPECT_EQ(scheduler.state().counters.exhibits_explained, 1U);
  EXPECT_EQ(next(31), "e2");
}

TEST_F(Scheduling, AKnownIdChangesNothing) {
  wish("a", RequestKind::exhibit, "e1", 0);
  const auto revision = scheduler.state().board.revision();
  wish("a", RequestKind::exhibit, "e1", 1);
  wish("a", RequestKind::tour, "t", 2);
  EXPECT_EQ(scheduler.state().board.revision(), revision);
  EXPECT_EQ(scheduler.state().board.entries().size(), 1U);
}

TEST_F(Scheduling, AFailedVisitIsTriedAgainBehindTheOthers) {
  wish("a", RequestKind::exhibit, "e1", 0);
  wish("b", RequestKind::exhibit, "e5", 0);
  EXPECT_EQ(next(1), "e1");
  finish(false, 60);
  EXPECT_EQ(state_of("a"), "queued");
  EXPECT_EQ(scheduler.state().board.find("a")->reason, ReasonWord::way_blocked);
  EXPECT_EQ(next(61), "e5");
  finish(true, 90);
  EXPECT_EQ(next(91), "") << "not before the delay is over";
  double at = 60.0;
  for (int attempt = 2; attempt <= params.max_attempts; ++attempt) {
    at += params.retry_after(attempt - 1) + 1.0;
    EXPECT_EQ(next(at - 2.0), "") << "a way that stays blocked is tried after longer and longer waits";
    EXPECT_EQ(next(at), "e1");
    finish(false, at);
  }
  EXPECT_EQ(state_of("a"), "failed");
  EXPECT_EQ(scheduler.state().board.find("a")->reason, ReasonWord::way_blocked);
  EXPECT_EQ(next(10000), "");
}

TEST_F(Scheduling, APassageThatIsClosedForTenMinutesOutlastsNoRequest) {
  double tried = 90.0;  // patience at the closed passage, every time
  for (int attempt = 1; attempt < params.max_attempts; ++attempt) tried += params.retry_after(attempt) + 90.0;
  EXPECT_GT(tried, 600.0 + 90.0);
  EXPECT_EQ(params.retry_after(1), params.retry_delay_s);
  EXPECT_EQ(params.retry_after(2), 2.0 * params.retry_delay_s);
  EXPECT_EQ(params.retry_after(30), params.retry_most_s);
}

TEST_F(Scheduling, ATourKeepsItsOrderAndServesSinglesOnTheWay) {
  wish("tour", RequestKind::tour, "t", 0);
  wish("same", RequestKind::exhibit, "e3", 1);   // a stop of the tour
  wish("close", RequestKind::exhibit, "e2", 2);  // no detour between e1 and e3
  EXPECT_EQ(serve_all(3), (std::vector<std::string>{"e1", "e2", "e3", "e5"}));
  for (const char* id : {"tour", "same", "close"}) EXPECT_EQ(state_of(id), "fulfilled") << id;
  EXPECT_EQ(scheduler.state().counters.tours_completed, 1U);
}

TEST_F(Scheduling, AVisitThatAWaitingTourWouldMakeAsWellBeginsTheTour) {
  wish("now", RequestKind::exhibit, "e2", 0);
  EXPECT_EQ(next(1), "e2");
  scheduler.close_visit();
  wish("single", RequestKind::exhibit, "e3", 2);
  wish("tour", RequestKind::tour, "t", 3);
  wish("other", RequestKind::exhibit, "e4", 4);
  finish(true, 30);
  EXPECT_EQ(serve_all(31), (std::vector<std::string>{"e1", "e3", "e4", "e5"})) << "e3 once for both";
  for (const char* id : {"single", "tour", "other"}) EXPECT_EQ(state_of(id), "fulfilled") << id;
}

TEST_F(Scheduling, ATourMakesNoLongDetours) {
  params.max_detour_m = 1.0;
  TourScheduler strict{params, programme_on_a_line(), straight_distance(), {}, {}};
  strict.submit({"tour", {}, RequestSource::web, "", RequestKind::tour, "two", -1, "en"}, conditions, {});
  strict.submit({"far", {}, RequestSource::web, "", RequestKind::exhibit, "e5", -1, "en"}, conditions, {});
  EXPECT_EQ(strict.begin_visit({6, 0}, {})->exhibit_id, "e2");
}

TEST_F(Scheduling, TheSameTourIsGivenOnceToAllWhoWait) {
  wish("a", RequestKind::tour, "t", 0);
  wish("b", RequestKind::tour, "t", 0);
  EXPECT_EQ(next(1), "e1");
  scheduler.close_visit();
  wish("late", RequestKind::tour, "t", 2);
  finish(true, 60);
  EXPECT_EQ(state_of("late"), "active") << "it joins where the tour is";
  EXPECT_EQ(next(61), "e3");
  finish(true, 120);
  EXPECT_EQ(next(121), "e5");
  finish(true, 180);
  EXPECT_EQ(state_of("a"), "fulfilled") << "the first round is over";
  EXPECT_EQ(state_of("late"), "active") << "it has not seen the first exhibit";
  wish("later", RequestKind::tour, "t", 181);
  EXPECT_EQ(state_of("later"), "queued") << "one tour does not go on for ever";
  EXPECT_EQ(next(182), "e1") << "what was missed comes at the end";
  finish(true, 240);
  EXPECT_EQ(state_of("late"), "fulfilled");
  EXPECT_EQ(scheduler.state().counters.tours_completed, 1U);
  EXPECT_EQ(serve_all(241), (std::vector<std::string>{"e1", "e3", "e5"}));
  EXPECT_EQ(state_of("later"), "fulfilled");
  EXPECT_EQ(scheduler.state().counters.tours_completed, 2U);
}

TEST_F(Scheduling, WhoJoinsATourWhileItExplainsIsShownThatExhibitAtTheEnd) {
  wish("a", RequestKind::tour, "t", 0);
  EXPECT_EQ(next(1), "e1");
  finish(false, 30);  // e1 comes again, behind e5
  EXPECT_EQ(next(31), "e3");
  scheduler.close_visit();
  wish("late", RequestKind::tour, "t", 32);
  finish(true, 60);
  wish("x", RequestKind::cancel, "a", 61);
  EXPECT_EQ(serve_all(62), (std::vector<std::string>{"e5", "e1", "e3"}));
  EXPECT_EQ(state_of("late"), "fulfilled");
  EXPECT_EQ(state_of("a"), "cancelled");
}

TEST_F(Scheduling, ViewpointsOfOneExhibitAreStopsOfTheirOwn) {
  wish("left", RequestKind::exhibit, "e2", 0, "en", 0);
  wish("any", RequestKind::exhibit, "e2", 1);
  wish("right", RequestKind::exhibit, "e2", 2, "en", 1);
  EXPECT_EQ(next(3, {8, 5}), "e2");
  EXPECT_EQ(scheduler.state().visit->map_from_base.y, 1.0);
  EXPECT_EQ(state_of("any"), "active") << "whoever does not mind takes part";
  EXPECT_EQ(state_of("right"), "queued");
  wish("right too", RequestKind::exhibit, "e2", 4, "en", 1);
  EXPECT_EQ(state_of("right too"), "queued") << "the visit under way is another";
  finish(true, 60);
  EXPECT_EQ(state_of("left"), "fulfilled");
  EXPECT_EQ(state_of("right"), "queued") << "it was not shown from there";
  EXPECT_EQ(next(61, {8, 1}), "e2");
  EXPECT_EQ(scheduler.state().visit->map_from_base.y, -1.0);
  finish(true, 120);
  EXPECT_EQ(state_of("right"), "fulfilled");
  EXPECT_EQ(state_of("right too"), "fulfilled");
  EXPECT_EQ(scheduler.state().counters.exhibits_explained, 2U);
}

TEST_F(Scheduling, AViewpointThatCannotBeReachedSpoilsTheExhibitForNobodyElse) {
  wish("blocked", RequestKind::exhibit, "e2", 0, "en", 0);
  EXPECT_EQ(next(1), "e2");
  finish(false, 20);  // furniture stands at that viewpoint; the wish is tried again later
  ASSERT_EQ(state_of("blocked"), "queued");
  wish("any", RequestKind::exhibit, "e2", 21);
  EXPECT_EQ(next(22), "e2");
  EXPECT_EQ(scheduler.state().visit->viewpoint, -1) << "the exhibit's own place is free";
  EXPECT_EQ(state_of("blocked"), "queued");
  finish(true, 60);
  EXPECT_EQ(state_of("any"), "fulfilled");
}

TEST_F(Scheduling, BeginsNothingThatTakesLongerThanItMay) {
  wish("tour", RequestKind::tour, "t", 0);
  double tour_s = 0.0;
  for (const double way_m : {4.0, 8.0, 8.0})
    tour_s += stop_duration({20.0, 0.0}, scheduler.times().way("", "", way_m, {}).mean_s, true, scheduler.times());
  EXPECT_FALSE(scheduler.begin_visit({0, 0}, {}, tour_s - 1.0));
  EXPECT_EQ(state_of("tour"), "queued");
  EXPECT_TRUE(scheduler.is_anything_due({}));
  EXPECT_TRUE(scheduler.begin_visit({0, 0}, {}, tour_s + 1.0));
}

TEST_F(Scheduling, TriesWhatNoWayIsKnownToInsteadOfChargingForIt) {
  const auto no_way_to_e5 = [](Point2 from, Point2 to) {
    return from.x == 20.0 || to.x == 20.0 ? std::numeric_limits<double>::infinity() : distance(from, to);
  };
  for (const bool is_tour : {false, true}) {
    TourScheduler walled{params, programme_on_a_line(), no_way_to_e5, {}, {}};
    walled.submit({"w",
                   {},
                   RequestSource::web,
                   "",
                   is_tour ? RequestKind::tour : RequestKind::exhibit,
                   is_tour ? "t" : "e5",
                   -1,
                   "en"},
                  conditions, {});
    EXPECT_TRUE(walled.begin_visit({0, 0}, {}, 600.0)) << is_tour;
  }
}

TEST_F(Scheduling, ATourThatIsBrokenOffTooOftenFailsInTheEnd) {
  wish("tour", RequestKind::tour, "t", 0);
  wish("single", RequestKind::exhibit, "e1", 0);
  EXPECT_EQ(next(1), "e1");
  scheduler.break_off(ReasonWord::battery_low, time_from_seconds(20));
  EXPECT_EQ(state_of("tour"), "queued");
  EXPECT_EQ(state_of("single"), "queued");
  EXPECT_EQ(scheduler.state().board.find("tour")->reason, ReasonWord::battery_low);
  EXPECT_FALSE(scheduler.state().visit || scheduler.state().tour);
  for (int i = 1; i < params.max_attempts; ++i) {
    EXPECT_NE(next(20 * i), "");
    scheduler.break_off(ReasonWord::battery_low, time_from_seconds(20 * i + 20));
  }
  EXPECT_EQ(state_of("tour"), "failed");
  EXPECT_EQ(scheduler.state().counters.tours_completed, 0U);
}

TEST_F(Scheduling, ATourMaySkipOneStopButNotTwo) {
  for (const int bad_stops : {1, 2}) {
    TourScheduler tour{params, programme_on_a_line(), straight_distance(), {}, {}};
    tour.submit({"a", {}, RequestSource::web, "", RequestKind::tour, "t", -1, "en"}, conditions, {});
    std::vector<std::string> told;
    double at = 0.0;
    while (const auto visit = tour.begin_visit({0, 0}, time_from_seconds(at))) {
      const bool is_bad = visit->exhibit_id == "e1" || (bad_stops == 2 && visit->exhibit_id == "e3");
      if (!is_bad) told.push_back(visit->exhibit_id);
      at += 60.0;
      tour.finish_visit(!is_bad, ReasonWord::no_way, time_from_seconds(at));
      ASSERT_LT(at, 3600.0);
    }
    EXPECT_EQ(told.back(), "e5") << "the rest is shown all the same";
    EXPECT_EQ(tour.state().board.find("a")->status, bad_stops == 1 ? RequestStatus::fulfilled : RequestStatus::failed);
    EXPECT_EQ(tour.state().board.find("a")->reason, Reason(ReasonWord::not_reached, bad_stops == 1 ? "e1" : "e1 e3"));
  }
}

TEST_F(Scheduling, ACancelledTourEndsAfterThePresentStop) {
  wish("a", RequestKind::tour, "t", 0);
  EXPECT_EQ(next(1), "e1");
  wish("x", RequestKind::cancel, "a", 2);
  EXPECT_EQ(state_of("a"), "cancelled");
  EXPECT_TRUE(scheduler.is_visit_unwanted());
  scheduler.drop_visit(time_from_seconds(3));
  EXPECT_EQ(next(4), "");
}

TEST_F(Scheduling, RefusesWithReasons) {
  const auto reason = [&](VisitorRequest request, const Conditions& now) {
    scheduler.submit(request, now, {});
    EXPECT_EQ(state_of(request.id), "refused") << request.id;
    return scheduler.state().board.find(request.id)->reason;
  };
  EXPECT_EQ(reason({"1", {}, RequestSource::web, "", RequestKind::exhibit, "e9", -1, ""}, {}),
            Reason(ReasonWord::no_such_exhibit, "e9"));
  EXPECT_EQ(reason({"1t", {}, RequestSource::web, "", RequestKind::tour, "t9", -1, ""}, {}),
            Reason(ReasonWord::no_such_tour, "t9"));
  EXPECT_EQ(reason({"2", {}, RequestSource::kiosk, "", RequestKind::exhibit, "e6", -1, ""}, {}),
            ReasonWord::for_web_only);
  EXPECT_EQ(reason({"3", {}, RequestSource::web, "", RequestKind::exhibit, "e1", -1, ""}, {false, OperatingMode::open}),
            ReasonWord::closed);
  EXPECT_EQ(reason({"4", {}, RequestSource::kiosk, "", RequestKind::exhibit, "e1", -1, ""}, {true, OperatingMode::web}),
            ReasonWord::web_only_now);
  const Word<RequestKind> dance{std::string{"dance"}};
  EXPECT_EQ(reason({"5", {}, RequestSource::web, "", dance, "e1", -1, ""}, {}),
            Reason(ReasonWord::not_understood, "dance"));
  EXPECT_EQ(scheduler.state().board.find("5")->request.kind.text(), "dance") << "it stands on the board as it came";
  EXPECT_EQ(reason({"6", {}, RequestSource::web, "", RequestKind::exhibit, "e2", 7, ""}, {}),
            ReasonWord::no_such_viewpoint);
  for (int i = 0; i < params.max_open; ++i) wish("q" + std::to_string(i), RequestKind::exhibit, "e1", 0);
  EXPECT_EQ(state_of("q" + std::to_string(params.max_open - 1)), "queued");
  EXPECT_EQ(reason({"7", {}, RequestSource::web, "", RequestKind::exhibit, "e1", -1, ""}, {}),
            ReasonWord::too_many_wait);
}

TEST_F(Scheduling, ServesTheStaffInEveryMode) {
  int number = 0;
  for (const Conditions& now :
       {Conditions{true, OperatingMode::closed}, {false, OperatingMode::open}, {true, OperatingMode::web}}) {
    const std::string id = "staff-" + std::to_string(++number);
    scheduler.submit({id, {}, RequestSource::staff, "", RequestKind::exhibit, "e1", -1, "en"}, now, {});
    EXPECT_NE(state_of(id), "refused") << to_text(now.mode);
  }
}

TEST_F(Scheduling, FailsWhatTheMuseumNoLongerHas) {
  wish("a", RequestKind::exhibit, "e1", 0);
  wish("b", RequestKind::tour, "t", 0);
  wish("c", RequestKind::exhibit, "e2", 0);
  EXPECT_EQ(next(1), "e1");
  Programme smaller = programme_on_a_line();
  smaller.exhibits.erase(smaller.exhibits.begin());
  smaller.tours.clear();
  TourScheduler later{params, smaller, straight_distance(), scheduler.state(), time_from_seconds(9)};
  EXPECT_EQ(later.state().board.find("a")->status, RequestStatus::failed);
  EXPECT_EQ(later.state().board.find("b")->status, RequestStatus::failed);
  EXPECT_FALSE(later.state().visit);
  EXPECT_EQ(later.begin_visit({0, 0}, time_from_seconds(10))->exhibit_id, "e2");
}

TEST_F(Scheduling, ATourThatTheMuseumNoLongerHasIsNotACompletedOne) {
  wish("a", RequestKind::tour, "t", 0);
  EXPECT_EQ(next(1), "e1");
  finish(true, 30);
  Programme smaller = programme_on_a_line();
  smaller.tours.clear();
  const TourScheduler later{params, smaller, straight_distance(), scheduler.state(), time_from_seconds(40)};
  EXPECT_EQ(later.state().board.find("a")->status, RequestStatus::failed);
  EXPECT_FALSE(later.state().tour);
  EXPECT_EQ(later.state().counters.tours_completed, 0U);
}

TEST_F(Scheduling, WhoAsksForATourBeforeItsFirstWordJoins) {
  wish("a", RequestKind::tour, "t", 0);
  EXPECT_EQ(next(1), "e1");
  wish("b", RequestKind::tour, "t", 2);
  EXPECT_EQ(state_of("b"), "active");
  EXPECT_EQ(serve_all_from_here(3), (std::vector<std::string>{"e1", "e3", "e5"}));
  EXPECT_EQ(state_of("b"), "fulfilled");
}

/// Whatever comes in, in whatever order: every request ends, counted once, and the board never breaks its rules.
TEST(SchedulerLaws, EveryRequestEnds) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Rng rng{seed};
    SchedulerParams params;
    auto scheduler =
        std::make_unique<TourScheduler>(params, programme_on_a_line(), straight_distance(), SchedulerState{}, Time{});
    Conditions conditions;
    int made = 0;
    double at = 0.0;
    for (int step = 0; step < 300; ++step) {
      at += rng.uniform(0.0, 60.0);
      const Time now = time_from_seconds(at);
      if (step < 150 && rng.chance(0.4)) {
        const double kind = rng.uniform();
        VisitorRequest request{"r" + std::to_string(made++),
                               now,
                               rng.chance(0.5) ? RequestSource::web : RequestSource::visitor,
                               "",
                               RequestKind::exhibit,
                               "e" + std::to_string(rng.integer(1, 7)),
                               -1,
                               "en"};
        if (rng.chance(0.3)) request.target = "e2";
        if (request.target == "e2") request.viewpoint = static_cast<int>(rng.integer(-1, 1));
        if (kind < 0.2) {
          request.kind = RequestKind::tour;
          request.target = rng.chance(0.5) ? "t" : "quick";
          request.viewpoint = -1;
        } else if (kind < 0.3) {
          request.kind = RequestKind::cancel;
          request.target = "r" + std::to_string(rng.integer(0, made));
        }
        scheduler->submit(request, conditions, now);
      }
      if (scheduler->is_visit_unwanted()) scheduler->drop_visit(now);
      if (rng.chance(0.1)) {  // a restart: everything that counts is in the state
        scheduler = std::make_unique<TourScheduler>(params, programme_on_a_line(), straight_distance(),
                                                    SchedulerState{scheduler->state()}, now);
      }
      if (scheduler->state().farewell) scheduler->finish_farewell(now);
      if (!scheduler->state().visit) {
        (void)scheduler->begin_visit({rng.uniform(0, 24), 0}, now);
      } else {
        if (rng.chance(0.5)) scheduler->close_visit();
        if (rng.chance(0.6)) finish_and_check(*scheduler, rng.chance(0.8), now);
      }
    }
    std::uint32_t served = 0;
    for (const BoardEntry& entry : scheduler->state().board.entries()) {
      EXPECT_FALSE(is_open(entry.status)) << "seed " << seed << ' ' << entry.request.id;
      if (entry.status == RequestStatus::fulfilled && entry.request.kind != RequestKind::cancel) ++served;
      if (entry.status == RequestStatus::failed || entry.status == RequestStatus::refused) {
        EXPECT_FALSE(entry.reason.is_none());
      }
    }
    EXPECT_EQ(scheduler->state().counters.requests_served, served) << "seed " << seed;
    EXPECT_EQ(scheduler->state().board.entries().size(), static_cast<std::size_t>(made)) << "seed " << seed;
  }
}

}  // namespace
}  // namespace docent::task_control
