#include "docent/telepresence/forum/forum.h"

#include <gtest/gtest.h>

namespace docent::telepresence {
namespace {

const Time kNow = time_from_seconds(1'000'000);

class TheForum : public testing::Test {
 protected:
  void SetUp() override {
    database_ = std::move(*Database::open(":memory:"));
    forum_ = std::move(*Forum::open(*database_, {3, 5, 600.0, 3}));
  }
  Forum::Written write(const std::string& id, const std::string& thread, const Person& author, const std::string& text,
                       Time now = kNow) {
    Post post;
    post.id = id;
    post.thread = thread;
    post.title = "About " + id;
    post.text = text;
    auto written = forum_->write(post, author, now);
    EXPECT_TRUE(written) << written.error().message;
    return *written;
  }
  std::vector<std::string> ids(const std::string& thread, const Person& reader, const std::string& after = "") {
    std::vector<std::string> ids;
    const auto posts = *forum_->posts(thread, after, reader);
    for (const Post& post : posts) ids.push_back(post.id);
    return ids;
  }
  using Ids = std::vector<std::string>;
  /// Everybody comes from a network of their own.
  static std::string from(const std::string& person) { return "network of " + person; }
  const Person eve_{"v-eve", "Eve", Rank::visitor}, bob_{"v-bob", "Bob", Rank::visitor}, viewer_;
  const Person moderator_{"account:grace", "grace", Rank::moderator};
  std::unique_ptr<Database> database_;
  std::unique_ptr<Forum> forum_;
};

TEST_F(TheForum, AFirstPostWaitsUntilAModeratorHasReadIt) {
  EXPECT_EQ(write("1", "1", eve_, "Hello"), Forum::Written::held);
  EXPECT_TRUE(forum_->threads(std::nullopt)->empty());
  EXPECT_EQ(ids("1", viewer_), Ids{});
  EXPECT_EQ(ids("1", eve_), Ids{"1"}) << "its author sees it";
  ASSERT_EQ(forum_->queue()->size(), 1U);
  EXPECT_TRUE(*forum_->judge("1", PostState::shown));
  EXPECT_EQ(ids("1", viewer_), Ids{"1"});
  EXPECT_TRUE(forum_->queue()->empty());
  EXPECT_EQ(write("2", "1", eve_, "And again"), Forum::Written::shown) << "she is known now";
  const auto threads = *forum_->threads(std::nullopt);
  ASSERT_EQ(threads.size(), 1U);
  EXPECT_EQ(threads[0].first.title, "About 1");
  EXPECT_EQ(threads[0].posts, 2);
}

TEST_F(TheForum, ManyNamesFromOneNetworkReportOnce) {
  ASSERT_EQ(write("1", "1", moderator_, "Welcome"), Forum::Written::shown);
  for (int i = 0; i < 10; ++i)
    EXPECT_TRUE(*forum_->report("1", {"v-" + std::to_string(i), "Eve", Rank::visitor}, "198.51.100.7"));
  EXPECT_EQ(ids("1", viewer_), Ids{"1"});
  EXPECT_EQ(forum_->queue()->at(0).reports, 1);
}

TEST_F(TheForum, PostsKeepTheRankOfTheirAuthor) {
  ASSERT_EQ(write("1", "1", moderator_, "Welcome"), Forum::Written::shown);
  ASSERT_EQ(write("2", "1", eve_, "Hello"), Forum::Written::held);
  EXPECT_EQ(forum_->find("1")->value().rank, Rank::moderator);
  EXPECT_EQ(forum_->find("2")->value().rank, Rank::visitor);
}

TEST_F(TheForum, WhoIsDistrustedWaitsAgain) {
  ASSERT_EQ(write("1", "1", eve_, "Hello"), Forum::Written::held);
  ASSERT_TRUE(*forum_->judge("1", PostState::shown));
  ASSERT_EQ(write("2", "1", eve_, "Again"), Forum::Written::shown);
  ASSERT_TRUE(forum_->distrust(eve_.id));
  EXPECT_EQ(write("3", "1", eve_, "Under another name"), Forum::Written::held);
}

TEST_F(TheForum, WhatManyReportIsReadAgain) {
  ASSERT_EQ(write("1", "1", moderator_, "Welcome"), Forum::Written::shown);
  EXPECT_TRUE(*forum_->report("1", eve_, from(eve_.id)));
  EXPECT_TRUE(*forum_->report("1", eve_, from(eve_.id))) << "again: it counts once";
  EXPECT_TRUE(*forum_->report("1", bob_, from(bob_.id)));
  EXPECT_EQ(forum_->queue()->at(0).reports, 2);
  EXPECT_EQ(ids("1", viewer_), Ids{"1"});
  EXPECT_TRUE(*forum_->report("1", {"v-ann", "Ann", Rank::visitor}, "198.51.100.3"));
  EXPECT_EQ(ids("1", viewer_), Ids{});
  EXPECT_FALSE(*forum_->report("1", bob_, from(bob_.id))) << "it is not shown";
  EXPECT_FALSE(*forum_->report("no such", bob_, from(bob_.id)));
  EXPECT_TRUE(*forum_->judge("1", PostState::shown));
  EXPECT_EQ(forum_->find("1")->value().reports, 0);
  EXPECT_FALSE(*forum_->judge("no such", PostState::hidden));
}

TEST_F(TheForum, NobodyWritesAllTheTime) {
  for (int i = 0; i < 5; ++i)
    EXPECT_EQ(write("1" + std::to_string(i), "1" + std::to_string(i), eve_, "x"), Forum::Written::held);
  EXPECT_EQ(write("20", "20", eve_, "x"), Forum::Written::too_often);
  EXPECT_EQ(write("14", "14", eve_, "x"), Forum::Written::held) << "sent once more: it is there already";
  EXPECT_EQ(write("20", "20", bob_, "x"), Forum::Written::held);
  EXPECT_EQ(write("21", "21", eve_, "x", kNow + seconds(601)), Forum::Written::held);
  EXPECT_EQ(forum_->queue()->size(), 3U) << "a page at a time";
}

TEST_F(TheForum, APostNeedsAThreadThatIsShownAndSomethingToSay) {
  EXPECT_EQ(write("2", "1", moderator_, "x"), Forum::Written::no_thread);
  ASSERT_EQ(write("1", "1", eve_, "x"), Forum::Written::held);
  EXPECT_EQ(write("2", "1", moderator_, "x"), Forum::Written::no_thread);
  EXPECT_EQ(write("3", "3", moderator_, " \n\u200b\n "), Forum::Written::empty);
}

TEST_F(TheForum, TextStaysText) {
  const std::string nasty = "<script>alert(1)</script>'; DROP TABLE posts; --\n\n\n\n\nend\u202e\x07";
  ASSERT_EQ(write("1", "1", moderator_, nasty), Forum::Written::shown);
  const Post post = forum_->find("1")->value();
  EXPECT_EQ(post.text, "<script>alert(1)</script>'; DROP TABLE posts; --\n\nend");
  ASSERT_EQ(write("2", "1", moderator_, std::string(5000, 'x')), Forum::Written::shown);
  EXPECT_EQ(forum_->find("2")->value().text.size(), Forum::kLongestText);
  EXPECT_EQ(*forum_->report("1' OR '1'='1", bob_, from(bob_.id)), false);
}

TEST_F(TheForum, IsReadAPageAtATime) {
  for (const char* id : {"1", "2", "3", "4"})
    ASSERT_EQ(write(id, id, moderator_, "x", kNow + seconds(id[0])), Forum::Written::shown);
  const auto page = *forum_->threads(std::nullopt);
  ASSERT_EQ(page.size(), 3U);
  EXPECT_EQ(page[0].first.id, "4");
  const auto rest = *forum_->threads(page[2].latest);
  ASSERT_EQ(rest.size(), 1U);
  EXPECT_EQ(rest[0].first.id, "1");
  for (const char* id : {"5", "6", "7"}) ASSERT_EQ(write(id, "1", moderator_, "x"), Forum::Written::shown);
  EXPECT_EQ(ids("1", viewer_), (Ids{"1", "5", "6"}));
  EXPECT_EQ(ids("1", viewer_, "6"), Ids{"7"});
}

TEST_F(TheForum, AllOfOnePersonCanBeHidden) {
  ASSERT_EQ(write("1", "1", eve_, "x"), Forum::Written::held);
  ASSERT_TRUE(*forum_->judge("1", PostState::shown));
  ASSERT_TRUE(forum_->hide_all_of("v-eve"));
  EXPECT_EQ(ids("1", eve_), Ids{});
  EXPECT_EQ(ids("1", moderator_), Ids{"1"});
  EXPECT_EQ(write("9", "9", eve_, "x"), Forum::Written::held) << "she is no longer trusted";
}

}  // namespace
}  // namespace docent::telepresence
