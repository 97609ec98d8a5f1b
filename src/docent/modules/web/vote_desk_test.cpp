#include "docent/modules/web/vote_desk.h"

#include <gtest/gtest.h>

#include "docent/messages/topics.h"
#include "docent/telepresence/client_message.h"
#include "docent/transport/virtual_time_bus.h"

namespace docent::modules {
namespace {

museum::Museum museum_with_tours() {
  museum::Museum museum;
  museum.tours = {{"space", {}, {"sputnik"}, std::nullopt}, {"quick", {}, {}, 6.0}};
  return museum;
}

class VoteDeskTest : public testing::Test {
 protected:
  void SetUp() override {
    database_ = std::move(*telepresence::Database::open(":memory:"));
    desk_ = std::make_unique<VoteDesk>(*bus_, museum_, std::move(*telepresence::TourVotes::open(*database_)), 1);
    world_->subscribe<docent_msgs::Votes>(topics::kVotes, [this](const auto& m) { told_.push_back(m); });
  }
  Reason vote(const std::string& voter, const std::string& tour) { return desk_->take({"id", voter, tour}); }
  std::optional<std::string> look() {
    auto shown = desk_->look();
    hub_.run_until(hub_.now() + seconds(1));
    return shown;
  }

  museum::Museum museum_ = museum_with_tours();
  transport::VirtualTimeHub hub_;
  std::unique_ptr<transport::Bus> world_ = hub_.connect("world");
  std::unique_ptr<transport::Bus> bus_ = hub_.connect("web");
  std::unique_ptr<telepresence::Database> database_;
  std::unique_ptr<VoteDesk> desk_;
  std::vector<docent_msgs::Votes> told_;
};

TEST_F(VoteDeskTest, TellsTheRobotHowTheVotesStand) {
  ASSERT_TRUE(look()) << "a round without votes is shown, too";
  EXPECT_EQ(vote("ada", "quick"), Reason{});
  EXPECT_EQ(vote("grace", "quick"), Reason{});
  EXPECT_EQ(vote("emmy", "space"), Reason{});
  ASSERT_TRUE(look());
  EXPECT_FALSE(look()) << "nothing is new";
  ASSERT_EQ(told_.size(), 2U);
  EXPECT_TRUE(telepresence::is_uuid7(told_[1].round));
  EXPECT_EQ(told_[1].tours, (std::vector<std::string>{"space", "quick"})) << "in the museum's order";
  EXPECT_EQ(told_[1].counts, (std::vector<std::uint32_t>{1, 2}));
}

TEST_F(VoteDeskTest, AVoteForNoTourIsRefused) {
  EXPECT_EQ(vote("ada", "nonsense"), (Reason{ReasonWord::no_such_tour, "nonsense"}));
}

TEST_F(VoteDeskTest, ANewRoundBeginsWhenTheRobotHasTakenTheTour) {
  EXPECT_EQ(vote("ada", "quick"), Reason{});
  ASSERT_TRUE(look());
  const std::string round = told_.back().round;
  docent_msgs::RequestBoard board;
  board.requests.resize(1);
  board.requests[0].request.id = "another request";
  desk_->see(board);
  EXPECT_FALSE(look());
  board.requests[0].request.id = round;
  desk_->see(board);
  ASSERT_TRUE(look());
  EXPECT_NE(told_.back().round, round);
  EXPECT_TRUE(told_.back().tours.empty());
}

}  // namespace
}  // namespace docent::modules
