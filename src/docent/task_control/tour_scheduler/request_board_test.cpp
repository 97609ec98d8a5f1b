#include "docent/task_control/tour_scheduler/request_board.h"

#include <gtest/gtest.h>

#include "docent/task_control/tour_scheduler/scheduling_fixture.h"

namespace docent::task_control {
namespace {

VisitorRequest request(const std::string& id) {
  return {id, {}, RequestSource::web, "Ada", RequestKind::exhibit, "sputnik", -1, "en"};
}

TEST(RequestBoard, StatusTextsRoundTrip) {
  for (int i = 0; i < 6; ++i) {
    const auto status = static_cast<RequestStatus>(i);
    EXPECT_EQ(parse<RequestStatus>(to_text(status)), status);
  }
  EXPECT_EQ(parse<RequestStatus>("lost"), std::nullopt);
}

TEST(RequestBoard, ClosedRequestsNeverOpenAgain) {
  for (int from = 2; from < 6; ++from) {
    for (int to = 0; to < 6; ++to) {
      EXPECT_FALSE(is_step(static_cast<RequestStatus>(from), static_cast<RequestStatus>(to)));
    }
  }
  EXPECT_TRUE(is_step(RequestStatus::active, RequestStatus::queued));
  EXPECT_FALSE(is_step(RequestStatus::queued, RequestStatus::fulfilled));
  EXPECT_FALSE(is_step(RequestStatus::queued, RequestStatus::refused));
}

TEST(RequestBoard, OpenOnesComeFirstInOrderOfArrival) {
  RequestBoard board;
  board.add(request("a"), RequestStatus::queued, {}, {1});
  board.add(request("b"), RequestStatus::refused, ReasonWord::closed, {2});
  board.add(request("c"), RequestStatus::queued, {}, {3});
  board.change("a", RequestStatus::active, {}, {4});
  board.change("a", RequestStatus::fulfilled, {}, {5});
  std::vector<std::string> ids;
  for (const auto& entry : board.entries()) ids.push_back(entry.request.id);
  EXPECT_EQ(ids, (std::vector<std::string>{"c", "b", "a"}));
  EXPECT_EQ(board.open_count(), 1U);
  EXPECT_EQ(board.find("a")->changed, Time{5});
  EXPECT_EQ(board.find("a")->created, Time{1});
  EXPECT_EQ(board.revision(), 5U);
}

TEST(RequestBoard, KeepsTheLastHundredClosedOnesAndNeverDropsWhatIsNotStored) {
  RequestBoard board;
  for (int i = 0; i < 150; ++i) board.add(request("r" + std::to_string(i)), RequestStatus::refused, {}, {i});
  EXPECT_EQ(board.entries().size(), 150U);
  board.mark_stored();
  board.add(request("last"), RequestStatus::refused, {}, {200});
  EXPECT_EQ(board.entries().size(), RequestBoard::kClosedKept);
  EXPECT_EQ(board.entries().back().request.id, "last");
  EXPECT_EQ(board.entries().front().request.id, "r51");
}

TEST(RequestBoard, RemembersWhatIsNotStored) {
  RequestBoard board;
  board.add(request("a"), RequestStatus::queued, {}, {1});
  EXPECT_EQ(board.unstored(), std::set<std::string>{"a"});
  board.mark_stored();
  EXPECT_TRUE(board.unstored().empty());
  board.count_attempt("a", {9});
  EXPECT_EQ(board.unstored(), std::set<std::string>{"a"});
  EXPECT_EQ(board.find("a")->attempts, 1);
}

// 120 wishes in 24 s for Bonn's 49 places: RHINO's queue held over 100 ([Rhino1999] 6).
TEST_F(Scheduling, TheBoardIsLimitedInStopsNotInWishes) {
  Programme programme = programme_on_a_line();
  for (int i = 0; i < 44; ++i) programme.exhibits[1].viewpoints.push_back({8, 0.1 * i, {}});
  TourScheduler busy{params, programme, straight_distance(), {}, {}};
  for (int i = 0; i < 120; ++i) {
    const int place = i % 49;
    const std::string exhibit = place < 5 ? "e" + std::to_string(place + 1) : "e2";
    busy.submit({"w" + std::to_string(i),
                 {},
                 RequestSource::web,
                 "",
                 RequestKind::exhibit,
                 exhibit,
                 place < 5 ? -1 : place - 5,
                 "en"},
                conditions, time_from_seconds(0.2 * i));
  }
  EXPECT_EQ(busy.board().open_count(), 120U);
  params.max_stops = 3;
  TourScheduler strict{params, programme, straight_distance(), {}, {}};
  for (int i = 0; i < 8; ++i) {
    strict.submit({"w" + std::to_string(i),
                   {},
                   RequestSource::web,
                   "",
                   RequestKind::exhibit,
                   "e" + std::to_string(1 + i % 4),
                   -1,
                   "en"},
                  conditions, {});
  }
  EXPECT_EQ(strict.board().open_count(), 6U) << "e4 is one too many, both times";
}

TEST_F(Scheduling, WishesForAStopThatSomebodyWaitsForAreTakenOnAFullBoard) {
  params.max_stops = 2;
  TourScheduler full{params, programme_on_a_line(), straight_distance(), {}, {}};
  const auto ask = [&](const std::string& id, const std::string& exhibit, int viewpoint) {
    full.submit({id, {}, RequestSource::web, "", RequestKind::exhibit, exhibit, viewpoint, "en"}, conditions, {});
    return full.state().board.find(id)->status;
  };
  EXPECT_EQ(ask("left", "e2", 0), RequestStatus::queued);
  EXPECT_EQ(ask("right", "e2", 1), RequestStatus::queued) << "one exhibit, two stops";
  EXPECT_EQ(ask("near", "e1", -1), RequestStatus::refused);
  EXPECT_EQ(ask("any", "e2", -1), RequestStatus::queued) << "either stop meets it";
  for (int i = 0; i < 50; ++i) EXPECT_EQ(ask("more" + std::to_string(i), "e2", i % 2), RequestStatus::queued) << i;
  EXPECT_EQ(full.state().board.stops_with({"", {}, {}, "", RequestKind::exhibit, "e2", 1, ""}), 2U);
}

}  // namespace
}  // namespace docent::task_control
