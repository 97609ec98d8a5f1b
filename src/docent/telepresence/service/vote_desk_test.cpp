#include "docent/telepresence/service/vote_desk.h"

#include <gtest/gtest.h>

#include "docent/telepresence/client_message.h"
#include "docent/telepresence/service/service_fixture.h"

namespace docent::telepresence {
namespace {

museum::Museum museum_with_tours() {
  museum::Museum museum;
  museum.tours = {{"space", {}, {"sputnik"}, std::nullopt}, {"quick", {}, {}, 6.0}};
  return museum;
}

class VoteDeskTest : public testing::Test {
 protected:
  void SetUp() override {
    database_ = std::move(*Database::open(":memory:"));
    queue_ = std::make_unique<StoreQueue>(*database_, StoreQueue::Post{});
    desk_ = std::make_unique<VoteDesk>(
        robot_, *queue_, museum_, std::move(*TourVotes::open(*database_)), 1,
        [this](std::string text) { shown_ = std::move(text); }, now_);
  }
  Reason vote(const std::string& voter, const std::string& tour) {
    std::optional<Reason> answered;
    desk_->take({"id", voter, tour}, now_, [&](const Reason& why_not) { answered = why_not; });
    EXPECT_TRUE(answered);
    return answered.value_or(ReasonWord::too_fast);
  }
  std::optional<std::string> look() {
    now_ = now_ + seconds(1);
    shown_.reset();
    desk_->look(now_);
    return shown_;
  }

  museum::Museum museum_ = museum_with_tours();
  Time now_;
  RobotEar robot_;
  std::unique_ptr<Database> database_;
  std::unique_ptr<StoreQueue> queue_;
  std::unique_ptr<VoteDesk> desk_;
  std::optional<std::string> shown_;
};

TEST_F(VoteDeskTest, TellsTheRobotHowTheVotesStand) {
  ASSERT_TRUE(look()) << "a round without votes is shown, too";
  EXPECT_EQ(vote("ada", "quick"), Reason{});
  EXPECT_EQ(vote("grace", "quick"), Reason{});
  EXPECT_EQ(vote("emmy", "space"), Reason{});
  ASSERT_TRUE(look());
  EXPECT_FALSE(look()) << "nothing is new";
  ASSERT_EQ(robot_.votes.size(), 2U);
  EXPECT_TRUE(is_uuid7(robot_.votes[1].round));
  EXPECT_EQ(robot_.votes[1].tours, (std::vector<std::string>{"space", "quick"})) << "in the museum's order";
  EXPECT_EQ(robot_.votes[1].counts, (std::vector<std::uint32_t>{1, 2}));
}

TEST_F(VoteDeskTest, ARoundThatCouldNotBeBegunIsBegunLater) {
  ASSERT_TRUE(database_->run("DELETE FROM vote_rounds"));  // as where nobody answered at the start
  EXPECT_EQ(vote("ada", "quick"), Reason{ReasonWord::not_stored});
  (void)look();
  EXPECT_EQ(vote("ada", "quick"), Reason{});
  ASSERT_TRUE(look());
  EXPECT_TRUE(is_uuid7(robot_.votes.back().round));
}

TEST_F(VoteDeskTest, AVoteForNoTourIsRefused) {
  EXPECT_EQ(vote("ada", "nonsense"), (Reason{ReasonWord::no_such_tour, "nonsense"}));
}

TEST_F(VoteDeskTest, ANewRoundBeginsWhenTheRobotHasTakenTheTour) {
  EXPECT_EQ(vote("ada", "quick"), Reason{});
  ASSERT_TRUE(look());
  const std::string round = robot_.votes.back().round;
  docent_msgs::RequestBoard board;
  board.requests.resize(1);
  board.requests[0].request.id = "another request";
  desk_->see(board, now_);
  EXPECT_FALSE(look());
  board.requests[0].request.id = round;
  desk_->see(board, now_);
  ASSERT_TRUE(look());
  EXPECT_NE(robot_.votes.back().round, round);
  EXPECT_TRUE(robot_.votes.back().tours.empty());
}

}  // namespace
}  // namespace docent::telepresence
