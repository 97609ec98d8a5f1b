#include "docent/telepresence/service/answer_desk.h"

#include <gtest/gtest.h>

#include "docent/telepresence/service/service_fixture.h"

namespace docent::telepresence {
namespace {

docent_msgs::Prompt prompt(const std::string& id) {
  docent_msgs::Prompt prompt;
  prompt.id = id;
  prompt.options = {"more", "next"};
  return prompt;
}

class AnswerDeskTest : public testing::Test {
 protected:
  Reason answer(const std::string& prompt, const std::string& choice) {
    return desk_.take({"id-" + choice, prompt, choice}, RequestSource::kiosk);
  }
  RobotEar robot_;
  AnswerDesk desk_{robot_};
};

TEST_F(AnswerDeskTest, OnlyAnOpenQuestionCanBeAnswered) {
  EXPECT_EQ(answer("p1", "more"), Reason{ReasonWord::question_over}) << "nothing was ever asked";
  desk_.see(prompt("p1"));
  EXPECT_EQ(answer("p2", "more"), Reason{ReasonWord::question_over});
  EXPECT_EQ(answer("p1", "faster"), Reason{ReasonWord::no_such_answer});
  EXPECT_TRUE(robot_.choices.empty());
  EXPECT_EQ(answer("p1", "more"), Reason{});
  ASSERT_EQ(robot_.choices.size(), 1U) << "at once";
  EXPECT_EQ(robot_.choices[0].id, "id-more");
  EXPECT_EQ(robot_.choices[0].prompt_id, "p1");
  EXPECT_EQ(robot_.choices[0].choice, "more");
  EXPECT_EQ(robot_.choices[0].source, "kiosk");
}

TEST_F(AnswerDeskTest, TheFirstAnswerCountsAndIsToldUntilTheQuestionIsClosed) {
  desk_.see(prompt("p1"));
  EXPECT_EQ(answer("p1", "more"), Reason{});
  EXPECT_EQ(answer("p1", "next"), Reason{}) << "taken, but too late";
  desk_.resend();
  ASSERT_EQ(robot_.choices.size(), 2U);
  for (const auto& choice : robot_.choices) EXPECT_EQ(choice.choice, "more");
  desk_.see(prompt(""));
  desk_.resend();
  EXPECT_EQ(robot_.choices.size(), 2U);
}

TEST_F(AnswerDeskTest, TheNextQuestionHasItsOwnAnswer) {
  desk_.see(prompt("p1"));
  EXPECT_EQ(answer("p1", "more"), Reason{});
  desk_.see(prompt("p2"));
  EXPECT_EQ(answer("p2", "next"), Reason{});
  desk_.resend();
  EXPECT_EQ(robot_.choices.back().prompt_id, "p2");
  EXPECT_EQ(robot_.choices.back().choice, "next");
}

}  // namespace
}  // namespace docent::telepresence
