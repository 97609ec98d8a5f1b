#include "docent/telepresence/tour_votes.h"

#include <gtest/gtest.h>

namespace docent::telepresence {
namespace {

class Voting : public testing::Test {
 protected:
  void SetUp() override {
    auto database = Database::open(":memory:");
    ASSERT_TRUE(database) << database.error().message;
    database_ = std::move(*database);
    auto votes = TourVotes::open(*database_);
    ASSERT_TRUE(votes) << votes.error().message;
    votes_ = std::move(*votes);
    ASSERT_TRUE(votes_->begin("round-1", {}));
  }
  [[nodiscard]] Tally tally() const {
    auto tally = votes_->tally();
    EXPECT_TRUE(tally) << tally.error().message;
    return *tally;
  }
  using Counts = std::map<std::string, std::uint32_t>;
  std::unique_ptr<Database> database_;
  std::unique_ptr<TourVotes> votes_;
};

TEST_F(Voting, OneVoteAVoterWhichMayChange) {
  ASSERT_TRUE(votes_->vote("ada", "space", time_from_seconds(1)));
  ASSERT_TRUE(votes_->vote("grace", "space", time_from_seconds(2)));
  EXPECT_EQ(tally().counts, (Counts{{"space", 2}}));
  ASSERT_TRUE(votes_->vote("ada", "computers", time_from_seconds(3)));
  EXPECT_EQ(tally().counts, (Counts{{"computers", 1}, {"space", 1}}));
  EXPECT_EQ(tally().round, "round-1");
}

TEST_F(Voting, ARoundEndsOnceAndTheNextIsEmpty) {
  ASSERT_TRUE(votes_->vote("ada", "space", {}));
  ASSERT_TRUE(votes_->close("round-1", "round-2", {}));
  EXPECT_EQ(tally().round, "round-2");
  EXPECT_EQ(tally().counts, Counts{});
  // Another gateway saw the same end, and had another id in mind.
  ASSERT_TRUE(votes_->close("round-1", "round-3", {}));
  EXPECT_EQ(tally().round, "round-2");
  ASSERT_TRUE(votes_->begin("round-4", {}));
  EXPECT_EQ(tally().round, "round-2");
  ASSERT_TRUE(votes_->vote("ada", "space", {})) << "in each round anew";
  EXPECT_EQ(tally().counts, (Counts{{"space", 1}}));
}

TEST_F(Voting, IsForgottenWhenOld) {
  ASSERT_TRUE(votes_->vote("ada", "space", time_from_seconds(10)));
  ASSERT_TRUE(votes_->close("round-1", "round-2", time_from_seconds(20)));
  ASSERT_TRUE(votes_->vote("ada", "space", time_from_seconds(30)));
  ASSERT_TRUE(votes_->forget_before(time_from_seconds(25)));
  EXPECT_EQ(tally().counts, (Counts{{"space", 1}}));
  EXPECT_EQ(database_->run("SELECT count(*) FROM votes")->rows.at(0).number(0), 1);
  EXPECT_EQ(database_->run("SELECT count(*) FROM vote_rounds")->rows.at(0).number(0), 1);
}

}  // namespace
}  // namespace docent::telepresence
