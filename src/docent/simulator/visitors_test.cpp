#include "docent/simulator/visitors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace docent::simulator::visitors_test {
namespace {

WishingVisitors make(double per_hour, std::uint64_t seed) {
  WishParams params;
  params.requests_per_hour = per_hour;
  return {params, {"a", "b", "c"}, {"t"}, Rng{seed}};
}

TEST(WishingVisitors, AskAsOftenAsToldAndNeverLessThanHalfOfIt) {
  double total = 0.0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    WishingVisitors visitors = make(24.0, seed);
    std::set<std::string> ids;
    int exhibits = 0;
    int offers = 0;
    for (int i = 0; i < 3600 * 2; ++i) {
      const Time now = time_from_seconds(i);
      const auto output = visitors.step(now, now - Time{});
      offers += static_cast<int>(output.offered.size());
      docent_msgs::RequestBoard board;
      for (const auto& request : output.requests) {
        EXPECT_TRUE(ids.insert(request.id).second);  // on the board at once: sent only once
        if (request.kind == "exhibit") ++exhibits;
        board.requests.push_back({request, "queued", "", {}, {}});
      }
      visitors.see_board(board);
    }
    EXPECT_EQ(ids.size(), static_cast<std::size_t>(offers));
    EXPECT_GE(offers, 2 * 13);
    EXPECT_GT(exhibits, offers / 3);
    total += offers / 2.0;
  }
  EXPECT_NEAR(total / 20.0, 24.0, 1.5);
}

TEST(WishingVisitors, AskForNothingWhereThereIsNothing) {
  WishingVisitors none = make(0.0, 1);
  WishingVisitors empty{WishParams{}, {}, {}, Rng{1}};
  for (int i = 0; i < 3600; ++i) {
    const Time now = time_from_seconds(i);
    EXPECT_TRUE(none.step(now, now - Time{}).requests.empty());
    EXPECT_TRUE(empty.step(now, now - Time{}).requests.empty());
  }
}

TEST(WishingVisitors, AskAsAScenarioSays) {
  WishingVisitors visitors = make(0.0, 1);
  visitors.ask({}, {"exhibit", "a", 2, "de", "web"});
  visitors.ask({}, {"tour", "t", -1, "en", ""});
  const auto output = visitors.step({}, {});
  ASSERT_EQ(output.requests.size(), 2U);
  EXPECT_EQ(output.requests[0].viewpoint, 2);
  EXPECT_EQ(output.requests[0].source, "web");
  EXPECT_EQ(output.requests[0].language, "de");
  EXPECT_EQ(output.requests[1].viewpoint, -1);
  EXPECT_EQ(output.requests[1].source, "visitor");
}

TEST(WishingVisitors, AnswerSomeQuestionsOnceAndInTime) {
  WishingVisitors visitors = make(0.0, 1);
  int more = 0;
  int next = 0;
  constexpr int kQuestions = 400;
  for (int i = 0; i < kQuestions; ++i) {
    const Time asked = time_from_seconds(10.0 * i);
    docent_msgs::MissionState mission;
    mission.prompt.id = "p" + std::to_string(i);
    mission.prompt.options = {"more", "next"};
    visitors.see_mission(asked, mission);
    visitors.see_mission(asked, mission);  // latched messages come again
    int answers = 0;
    for (int tenth = 0; tenth < 50; ++tenth) {
      const Time now = asked + seconds(0.1 * tenth);
      for (const auto& choice : visitors.step(now, now - Time{}).choices) {
        EXPECT_EQ(choice.prompt_id, mission.prompt.id);
        ++answers;
        ++(choice.choice == "more" ? more : next);
      }
    }
    EXPECT_LE(answers, 1);
  }
  EXPECT_NEAR(more, 0.3 * kQuestions, 35);
  EXPECT_NEAR(next, 0.2 * kQuestions, 30);
}

}  // namespace
}  // namespace docent::simulator::visitors_test
