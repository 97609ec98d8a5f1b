#include "docent/telepresence/service/screen_desk.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "docent/telepresence/service/service_fixture.h"

namespace docent::telepresence {
namespace {

class ScreenDeskTest : public testing::Test {
 protected:
  std::optional<Reason> take(const ClientMessage& message, std::optional<MissionPhase> phase) {
    std::optional<Reason> answered;
    desk_.take(message, phase, now_, [&](const std::string&, const Reason& why_not) { answered = why_not; });
    return answered;
  }
  void run(double duration) {
    for (const Time end = now_ + seconds(duration); now_ < end; desk_.look(now_))
      now_ = std::min(end, now_ + seconds(1));
  }
  ScreenDesk::Means means() {
    return {[this](const AnswerMessage& answer, Time) -> Result<void> {
              if (is_disk_full_) return fail("poll.csv: the disk is full");
              kept_.push_back(answer);
              return {};
            },
            [](const std::string& language) { return "I can do much (" + language + ")"; }};
  }

  Time now_;
  RobotEar robot_;
  std::vector<AnswerMessage> kept_;
  bool is_disk_full_ = false;
  std::unique_ptr<Database> database_ = Database::open(":memory:").value();
  StoreQueue queue_{*database_, {}};
  ScreenDesk desk_{robot_, queue_, means(), now_};
};

TEST_F(ScreenDeskTest, LampsAreToldWhenTheyChange) {
  using Lit = std::vector<std::int32_t>;
  const auto light = [this](std::vector<int> lit) {
    EXPECT_FALSE(take(LampsMessage{std::move(lit)}, MissionPhase::idle)) << "has no id to answer";
  };
  EXPECT_EQ(robot_.lamps, (std::vector<Lit>{{}})) << "dark at the start";
  light({1, 2});
  run(0.1);
  light({1, 2});
  run(0.1);
  light({3});
  run(0.1);
  EXPECT_EQ(robot_.lamps, (std::vector<Lit>{{}, {1, 2}, {3}}));
}

TEST_F(ScreenDeskTest, AScreenThatIsGoneHasNoLamps) {
  for (int i = 0; i < 6; ++i) {
    take(LampsMessage{{4}}, MissionPhase::idle);
    run(5.0);  // as often as the page says it
    EXPECT_EQ(robot_.lamps.back(), std::vector<std::int32_t>{4});
  }
  run(15.0);
  EXPECT_EQ(robot_.lamps.back(), std::vector<std::int32_t>{});
  EXPECT_EQ(robot_.lamps.size(), 3U);
}

TEST_F(ScreenDeskTest, HelpIsSaidWhenTheRobotHasTime) {
  const HelpMessage help{"id-1", "de"};
  for (const auto phase : {std::optional<MissionPhase>{}, std::optional{MissionPhase::driving},
                           std::optional{MissionPhase::explaining}, std::optional{MissionPhase::asking}}) {
    const auto done = take(help, phase);
    EXPECT_EQ(done, Reason{ReasonWord::busy});
  }
  run(0.1);
  EXPECT_TRUE(robot_.says.empty());
  for (const auto phase : {MissionPhase::idle, MissionPhase::waiting, MissionPhase::charging}) {
    const auto done = take(help, phase);
    EXPECT_EQ(done, Reason{});
  }
  run(0.1);
  ASSERT_EQ(robot_.says.size(), 3U);
  EXPECT_EQ(robot_.says[0].id, "id-1");
  EXPECT_EQ(robot_.says[0].language, "de");
  EXPECT_EQ(robot_.says[0].text, "I can do much (de)");
}

TEST_F(ScreenDeskTest, AnAnswerIsKeptOrRefused) {
  const AnswerMessage answer{"id-1", PollQuestion::satisfied, PollAnswer::no, "fr"};
  EXPECT_EQ(take(answer, MissionPhase::idle), Reason{});
  ASSERT_EQ(kept_.size(), 1U);
  EXPECT_EQ(kept_[0].answer, PollAnswer::no);
  EXPECT_EQ(desk_.fault(), "");
  is_disk_full_ = true;
  EXPECT_EQ(take(answer, MissionPhase::idle), Reason{ReasonWord::not_stored});
  EXPECT_EQ(desk_.fault(), "poll.csv: the disk is full");
  is_disk_full_ = false;
  EXPECT_EQ(take(answer, MissionPhase::idle), Reason{});
  EXPECT_EQ(desk_.fault(), "");
}

TEST_F(ScreenDeskTest, AStopIsSkippedWhileOneIsUnderWay) {
  const SkipMessage skip{"id-1", "zuse"};
  EXPECT_EQ(take(skip, MissionPhase::idle), Reason{ReasonWord::no_such_request});
  EXPECT_EQ(take(skip, std::nullopt), Reason{ReasonWord::no_such_request});
  EXPECT_TRUE(robot_.requests.empty());
  for (const auto phase : {MissionPhase::driving, MissionPhase::explaining, MissionPhase::asking})
    EXPECT_EQ(take(skip, phase), Reason{});
  ASSERT_EQ(robot_.requests.size(), 3U);
  EXPECT_EQ(robot_.requests[0].kind, "skip");
  EXPECT_EQ(robot_.requests[0].target, "zuse");
  EXPECT_EQ(robot_.requests[0].source, "kiosk");
}

TEST_F(ScreenDeskTest, WishesAreNoMatterOfItsOwn) {
  EXPECT_FALSE(take(RequestMessage{}, MissionPhase::idle));
  EXPECT_FALSE(take(CancelMessage{}, MissionPhase::idle));
  EXPECT_FALSE(take(ChoiceMessage{}, MissionPhase::idle));
}

}  // namespace
}  // namespace docent::telepresence
