#include "docent/modules/web/screen_desk.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "docent/base/files.h"
#include "docent/interaction/speech/sentences.h"
#include "docent/messages/conversions.h"
#include "docent/transport/virtual_time_bus.h"

namespace docent::modules {
namespace {

class ScreenDeskTest : public testing::Test {
 protected:
  void SetUp() override {
    world_->subscribe<docent_msgs::ButtonLamps>(topics::kButtonLamps,
                                                [this](const auto& m) { lamps_.push_back(m.lit); });
    world_->subscribe<docent_msgs::Say>(topics::kSay, [this](const auto& m) { says_.push_back(m); });
    run(0.1);
  }
  void TearDown() override { std::filesystem::remove(file_); }
  void run(double duration) {
    for (const Time end = hub_.now() + seconds(duration); hub_.now() < end; desk_.look())
      hub_.run_until(std::min(end, hub_.now() + seconds(1)));
  }

  std::filesystem::path file_ =
      std::filesystem::temp_directory_path() / ("docent-desk-" + std::to_string(::getpid()) + ".csv");
  transport::VirtualTimeHub hub_;
  std::unique_ptr<transport::Bus> world_ = hub_.connect("world");
  std::unique_ptr<transport::Bus> bus_ = hub_.connect("web");
  std::vector<std::vector<std::int32_t>> lamps_;
  std::vector<docent_msgs::Say> says_;
  ScreenDesk desk_{*bus_, file_};
};

TEST_F(ScreenDeskTest, LampsAreToldWhenTheyChange) {
  using Lit = std::vector<std::int32_t>;
  const auto light = [this](std::vector<int> lit) {
    const auto done = desk_.take(telepresence::LampsMessage{std::move(lit)}, MissionPhase::idle);
    ASSERT_EQ(done, Reason{});
  };
  EXPECT_EQ(lamps_, (std::vector<Lit>{{}})) << "dark at the start";
  light({1, 2});
  run(0.1);
  light({1, 2});
  run(0.1);
  light({3});
  run(0.1);
  EXPECT_EQ(lamps_, (std::vector<Lit>{{}, {1, 2}, {3}}));
}

TEST_F(ScreenDeskTest, AScreenThatIsGoneHasNoLamps) {
  for (int i = 0; i < 6; ++i) {
    ASSERT_TRUE(desk_.take(telepresence::LampsMessage{{4}}, MissionPhase::idle));
    run(5.0);  // as often as the page says it
    EXPECT_EQ(lamps_.back(), std::vector<std::int32_t>{4});
  }
  run(15.0);
  EXPECT_EQ(lamps_.back(), std::vector<std::int32_t>{});
  EXPECT_EQ(lamps_.size(), 3U);
}

TEST_F(ScreenDeskTest, HelpIsSaidWhenTheRobotHasTime) {
  const telepresence::HelpMessage help{"id-1", "de"};
  for (const auto phase : {std::optional<MissionPhase>{}, std::optional{MissionPhase::driving},
                           std::optional{MissionPhase::explaining}, std::optional{MissionPhase::asking}}) {
    const auto done = desk_.take(help, phase);
    EXPECT_EQ(done, Reason{ReasonWord::busy});
  }
  run(0.1);
  EXPECT_TRUE(says_.empty());
  for (const auto phase : {MissionPhase::idle, MissionPhase::waiting, MissionPhase::charging}) {
    const auto done = desk_.take(help, phase);
    EXPECT_EQ(done, Reason{});
  }
  run(0.1);
  ASSERT_EQ(says_.size(), 3U);
  EXPECT_EQ(says_[0].id, "id-1");
  EXPECT_EQ(says_[0].language, "de");
  EXPECT_EQ(says_[0].text, interaction::sentence(interaction::Sentence::help, "de", Mood::neutral, 0));
}

TEST_F(ScreenDeskTest, AnAnswerIsKeptOnce) {
  for (int i = 0; i < 2; ++i) {
    const auto done = desk_.take(telepresence::AnswerMessage{"id-1", PollQuestion::satisfied, PollAnswer::no, "fr"},
                                 MissionPhase::idle);
    ASSERT_EQ(done, Reason{});
  }
  const std::string text = read_file(file_).value();
  EXPECT_TRUE(text.ends_with("fr,satisfied,no\n")) << text;
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2);
}

TEST_F(ScreenDeskTest, WishesAreNoMatterOfItsOwn) {
  EXPECT_FALSE(desk_.take(telepresence::RequestMessage{}, MissionPhase::idle));
  EXPECT_FALSE(desk_.take(telepresence::CancelMessage{}, MissionPhase::idle));
  EXPECT_FALSE(desk_.take(telepresence::ChoiceMessage{}, MissionPhase::idle));
}

}  // namespace
}  // namespace docent::modules
