#include "docent/telepresence/service/wish_desk.h"

#include <gtest/gtest.h>

#include "docent/messages/conversions.h"
#include "docent/telepresence/service/service_fixture.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::telepresence {
namespace {

docent_msgs::Request wish_for(const std::string& id, const std::string& target,
                              RequestKind kind = RequestKind::exhibit) {
  docent_msgs::Request wish;
  wish.id = id;
  wish.kind = to_text(kind);
  wish.target = target;
  return wish;
}

docent_msgs::RequestBoard board_of(const std::vector<std::pair<std::string, RequestStatus>>& entries) {
  docent_msgs::RequestBoard board;
  for (const auto& [id, status] : entries) {
    auto& entry = board.requests.emplace_back();
    entry.request.id = id;
    entry.state = to_text(status);
  }
  return board;
}

class WishDeskTest : public testing::Test {
 protected:
  std::unique_ptr<WishDesk> make(bool is_shared = false) {
    auto outbox = Outbox::open(*database_).value();
    auto pending = outbox->pending().value();
    return std::make_unique<WishDesk>(robot_, queue_, std::move(outbox), std::move(pending), is_shared);
  }
  Reason take(docent_msgs::Request wish, const std::string& network = "192.0.2.1") {
    std::optional<Reason> answered;
    desk_->take(std::move(wish), network, now_, [&](const Reason& why_not) { answered = why_not; });
    EXPECT_TRUE(answered);
    return answered.value_or(ReasonWord::too_fast);
  }
  void see(const docent_msgs::RequestBoard& board) { desk_->see(board, now_); }
  /// What the robot is told when it is told again.
  std::vector<std::string> resent() {
    robot_.requests.clear();
    desk_->resend(now_);
    std::vector<std::string> ids;
    for (const auto& request : robot_.requests) ids.push_back(request.id);
    return ids;
  }

  using Ids = std::vector<std::string>;
  Time now_ = time_from_seconds(100.0);
  RobotEar robot_;
  std::unique_ptr<Database> database_ = Database::open(":memory:").value();
  StoreQueue queue_{*database_, {}};
  std::unique_ptr<WishDesk> desk_ = make();
};

TEST_F(WishDeskTest, AWishIsToldUntilItIsOnTheBoard) {
  EXPECT_EQ(take(wish_for("a", "sputnik")), Reason{});
  ASSERT_EQ(robot_.requests.size(), 1U) << "at once";
  EXPECT_EQ(robot_.requests[0].target, "sputnik");
  EXPECT_EQ(from_message(robot_.requests[0].stamp), now_);
  now_ = now_ + std::chrono::hours{1};
  EXPECT_EQ(resent(), Ids{"a"});
  see(board_of({{"b", RequestStatus::queued}}));
  EXPECT_EQ(resent(), Ids{"a"}) << "that was another one";
  see(board_of({{"a", RequestStatus::refused}}));
  EXPECT_EQ(resent(), Ids{});
}

TEST_F(WishDeskTest, AWishThatIsSaidAgainIsKeptOnceAndToldOnce) {
  EXPECT_EQ(take(wish_for("a", "sputnik")), Reason{});
  see(board_of({{"a", RequestStatus::queued}}));
  robot_.requests.clear();
  EXPECT_EQ(take(wish_for("a", "sputnik")), Reason{});
  EXPECT_EQ(robot_.requests.size(), 1U) << "in case the mission lost it";
  EXPECT_EQ(resent(), Ids{});
}

TEST_F(WishDeskTest, AWishThatCannotBeStoredIsNotTold) {
  ASSERT_TRUE(database_->run("DROP TABLE outbox"));
  EXPECT_EQ(take(wish_for("a", "sputnik")), Reason{ReasonWord::not_stored});
  EXPECT_TRUE(robot_.requests.empty());
  EXPECT_FALSE(desk_->fault().empty());
}

TEST_F(WishDeskTest, AWishOfTheHallThatCannotBeStoredIsAcknowledgedOnceItIsOnTheBoard) {
  ASSERT_TRUE(database_->run("DROP TABLE outbox"));
  std::vector<Reason> answered;
  const auto ask = [&](docent_msgs::Request wish) {
    desk_->take(
        std::move(wish), "", now_, [&](const Reason& why_not) { answered.push_back(why_not); }, StoreQueue::Of::ours);
  };
  ask(wish_for("a", "sputnik"));
  ask(wish_for("b", "sputnik"));
  ask(wish_for("c", "x", RequestKind::cancel));
  EXPECT_TRUE(answered.empty()) << "nothing is kept yet";
  EXPECT_EQ(robot_.requests.size(), 3U);
  EXPECT_EQ(desk_->waiting(), 3U);
  EXPECT_EQ(resent(), (Ids{"a", "b", "c"}));
  see(board_of({{"a", RequestStatus::queued}, {"x", RequestStatus::cancelled}}));
  EXPECT_EQ(answered, (std::vector<Reason>{{}, {}}));
  EXPECT_EQ(resent(), Ids{"b"});
  now_ = now_ + seconds(4.0);
  desk_->look(now_);
  EXPECT_EQ(answered.size(), 2U);
  now_ = now_ + seconds(2.0);
  desk_->look(now_);
  ASSERT_EQ(answered.size(), 3U);
  EXPECT_EQ(answered[2], Reason{ReasonWord::not_stored});
  EXPECT_EQ(resent(), Ids{});
}

TEST_F(WishDeskTest, TheHallIsToldAfterACrowdWhoseRestComesLater) {
  for (int i = 0; i < 100; ++i) EXPECT_EQ(take(wish_for("w" + std::to_string(i), "sputnik")), Reason{});
  auto hall = wish_for("hall", "sputnik");
  hall.source = to_text(RequestSource::kiosk);
  EXPECT_EQ(take(hall), Reason{});
  for (int i = 100; i < 200; ++i) EXPECT_EQ(take(wish_for("w" + std::to_string(i), "sputnik")), Reason{});
  const Ids told = resent();
  EXPECT_LE(told.size(), 32U) << "as many as a late reader keeps";
  EXPECT_EQ(told.front(), "w0");
  EXPECT_EQ(told.back(), "hall");
  std::vector<std::pair<std::string, RequestStatus>> entries;
  for (const std::string& id : told) entries.emplace_back(id, RequestStatus::queued);
  see(board_of(entries));
  EXPECT_EQ(resent().front(), "w24") << "and then the next ones";
}

TEST_F(WishDeskTest, ACancellationIsSeenInWhatItCancels) {
  see(board_of({{"a", RequestStatus::queued}}));
  EXPECT_EQ(take(wish_for("c", "a", RequestKind::cancel)), Reason{});
  see(board_of({{"a", RequestStatus::active}}));
  EXPECT_EQ(resent(), Ids{"c"});
  see(board_of({{"a", RequestStatus::cancelled}}));
  EXPECT_EQ(resent(), Ids{});
}

TEST_F(WishDeskTest, ACancellationOfWhatNobodyKnowsIsGivenUpAfterAMinute) {
  EXPECT_EQ(take(wish_for("c", "unknown", RequestKind::cancel)), Reason{});
  EXPECT_EQ(take(wish_for("a", "sputnik")), Reason{});
  now_ = now_ + seconds(59.0);
  EXPECT_EQ(resent(), (Ids{"c", "a"}));
  now_ = now_ + seconds(2.0);
  EXPECT_EQ(resent(), Ids{"a"});
}

TEST_F(WishDeskTest, KnowsHowManyWait) {
  EXPECT_EQ(desk_->waiting(), 0U);
  EXPECT_EQ(take(wish_for("a", "sputnik")), Reason{});
  EXPECT_EQ(desk_->waiting(), 1U);
  see(board_of({{"a", RequestStatus::queued}, {"b", RequestStatus::active}, {"c", RequestStatus::fulfilled}}));
  EXPECT_EQ(desk_->waiting(), 2U);
}

TEST_F(WishDeskTest, KnowsHowManyWaitOfWhom) {
  EXPECT_EQ(take(wish_for("a", "sputnik")), Reason{});
  EXPECT_EQ(take(wish_for("b", "sputnik")), Reason{});
  EXPECT_EQ(take(wish_for("c", "sputnik"), "192.0.2.2"), Reason{});
  EXPECT_EQ(take(wish_for("d", "c", RequestKind::cancel)), Reason{});
  EXPECT_EQ(desk_->waiting_of("192.0.2.1"), 2U);
  EXPECT_EQ(desk_->waiting_of("192.0.2.2"), 1U);
  see(board_of({{"a", RequestStatus::queued}, {"b", RequestStatus::fulfilled}, {"c", RequestStatus::refused}}));
  EXPECT_EQ(desk_->waiting_of("192.0.2.1"), 1U);
  EXPECT_EQ(desk_->waiting_of("192.0.2.2"), 0U);
}

TEST_F(WishDeskTest, WhatIsTooOldIsForgotten) {
  EXPECT_EQ(take(wish_for("a", "sputnik")), Reason{});
  desk_->forget_before(now_ + seconds(1.0), now_);
  EXPECT_EQ(resent(), Ids{});
}

TEST_F(WishDeskTest, TellsWhatAnotherGatewayTookWhereTheyShareADatabase) {
  const auto shared = make(true);
  EXPECT_EQ(take(wish_for("a", "sputnik")), Reason{});
  robot_.requests.clear();
  shared->resend(now_);
  ASSERT_EQ(robot_.requests.size(), 1U);
  EXPECT_EQ(robot_.requests[0].id, "a");
}

}  // namespace
}  // namespace docent::telepresence
