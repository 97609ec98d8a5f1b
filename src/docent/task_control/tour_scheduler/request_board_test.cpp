#include "docent/task_control/tour_scheduler/request_board.h"

#include <gtest/gtest.h>

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
  board.add(request("a"), RequestStatus::queued, "", {1});
  board.add(request("b"), RequestStatus::refused, "closed", {2});
  board.add(request("c"), RequestStatus::queued, "", {3});
  board.change("a", RequestStatus::active, "", {4});
  board.change("a", RequestStatus::fulfilled, "", {5});
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
  for (int i = 0; i < 150; ++i) board.add(request("r" + std::to_string(i)), RequestStatus::refused, "", {i});
  EXPECT_EQ(board.entries().size(), 150U);
  board.mark_stored();
  board.add(request("last"), RequestStatus::refused, "", {200});
  EXPECT_EQ(board.entries().size(), RequestBoard::kClosedKept);
  EXPECT_EQ(board.entries().back().request.id, "last");
  EXPECT_EQ(board.entries().front().request.id, "r51");
}

TEST(RequestBoard, RemembersWhatIsNotStored) {
  RequestBoard board;
  board.add(request("a"), RequestStatus::queued, "", {1});
  EXPECT_EQ(board.unstored(), std::set<std::string>{"a"});
  board.mark_stored();
  EXPECT_TRUE(board.unstored().empty());
  board.count_attempt("a", {9});
  EXPECT_EQ(board.unstored(), std::set<std::string>{"a"});
  EXPECT_EQ(board.find("a")->attempts, 1);
}

}  // namespace
}  // namespace docent::task_control
