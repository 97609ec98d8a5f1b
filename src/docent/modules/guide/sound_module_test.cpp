#include "docent/modules/guide/sound_module.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "docent/base/files.h"
#include "docent/interaction/speech/horn.h"
#include "docent/interaction/speech/renderer.h"
#include "docent/interaction/speech/spoken_text.h"
#include "docent/messages/conversions.h"
#include "docent/transport/virtual_time_bus.h"

namespace docent::modules {
namespace {

class Sound : public testing::Test {
 protected:
  Sound() : folder_{std::filesystem::temp_directory_path() / ("docent_sound_" + std::to_string(getpid()))} {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    listener_ = hub_.connect("listener");
    say_ = listener_->publisher(topics::kSay);
    limits_ = listener_->publisher(topics::kLimits);
    listener_->subscribe<docent_msgs::SpeechState>(topics::kSpeechState,
                                                   [this](const auto& state) { heard_.push_back(state); });
  }
  ~Sound() override {
    kill();
    std::filesystem::remove_all(folder_);
  }
  void start(bool virtual_time) {
    bus_ = hub_.connect("sound");
    auto module = make_sound({*bus_, museum_, config_, folder_, 1, virtual_time});
    ASSERT_TRUE(module) << module.error().message;
    module_ = std::move(*module);
  }
  void kill() {
    module_.reset();
    bus_.reset();
  }
  void say(const std::string& id, const std::string& text) { say_.publish({id, text, "en", "neutral"}); }
  void run_for(double duration_s) { hub_.run_until(hub_.now() + seconds(duration_s)); }
  /// Lets wall time pass until something was heard that was not before.
  void wait_for_news() {
    const std::size_t before = heard_.size();
    for (int i = 0; i < 1000 && heard_.size() == before; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      run_for(0.001);
    }
    ASSERT_GT(heard_.size(), before);
  }

  std::filesystem::path folder_;
  transport::VirtualTimeHub hub_;
  museum::Museum museum_;
  robot::RobotConfig config_;
  std::unique_ptr<transport::Bus> listener_;
  transport::Publisher<docent_msgs::Say> say_;
  transport::Publisher<docent_msgs::Limits> limits_;
  std::vector<docent_msgs::SpeechState> heard_;
  std::unique_ptr<transport::Bus> bus_;
  std::unique_ptr<Module> module_;
};

const std::string kText = "The first satellite was launched in October. It beeped for three weeks.";

TEST_F(Sound, InVirtualTimeTheTextForetellsTheDuration) {
  start(true);
  say("t1/short", kText);
  run_for(0.5);
  ASSERT_EQ(heard_.size(), 1U);
  EXPECT_EQ(heard_[0].state, "speaking");
  EXPECT_EQ(heard_[0].audio, "");
  EXPECT_DOUBLE_EQ(heard_[0].duration, interaction::speech_duration(kText, "en", Mood::neutral));
  run_for(heard_[0].duration);
  ASSERT_EQ(heard_.size(), 2U);
  EXPECT_EQ(heard_[1].state, "done");
  EXPECT_EQ(heard_[1].id, "t1/short");
}

TEST_F(Sound, AnOrderThatIsRepeatedIsAnsweredButNotSaidAgain) {
  start(true);
  say("t1/short", kText);
  run_for(1.0);
  say("t1/short", kText);
  run_for(1.0);
  ASSERT_EQ(heard_.size(), 2U);
  EXPECT_EQ(from_message(heard_[1].start), from_message(heard_[0].start));
  run_for(60.0);
  say("t1/short", kText);
  run_for(1.0);
  EXPECT_EQ(heard_.back().state, "done");
  say("t2/short", kText);
  run_for(60.0);
  const std::size_t before = heard_.size();
  say("t1/short", kText);
  run_for(1.0);
  ASSERT_EQ(heard_.size(), before + 2);
  EXPECT_EQ(heard_[before].id, "t1/short");
  EXPECT_EQ(heard_[before].state, "done");
  EXPECT_EQ(heard_.back().id, "t2/short") << "the latched state is that of the newest line";
}

TEST_F(Sound, ANewerLineReplacesTheOlderOne) {
  start(true);
  say("a", kText);
  run_for(1.0);
  say("b", "Please let me through.");
  run_for(0.1);
  EXPECT_EQ(heard_.back().id, "b");
  EXPECT_EQ(heard_.back().state, "speaking");
  run_for(20.0);
  EXPECT_EQ(heard_.back().id, "b");
  EXPECT_EQ(heard_.back().state, "done");
}

TEST_F(Sound, ARestartInTheMiddleSpeaksOnToTheEnd) {
  start(true);
  say("t1/short", kText);
  run_for(1.0);
  const auto first = heard_.back();
  kill();
  run_for(1.0);
  start(true);
  run_for(0.2);
  EXPECT_EQ(heard_.back().state, "speaking");
  EXPECT_EQ(from_message(heard_.back().start), from_message(first.start));
  run_for(first.duration);
  EXPECT_EQ(heard_.back().state, "done");
  EXPECT_NEAR(to_seconds(from_message(heard_.back().header.stamp) - from_message(first.start)), first.duration, 0.2);
}

TEST_F(Sound, UnderWallTimeItRendersAWavFile) {
  start(false);
  say("t1/short", kText);
  wait_for_news();
  EXPECT_EQ(heard_[0].state, "speaking");
  EXPECT_EQ(heard_[0].audio, interaction::audio_file_name({kText, "en", Mood::neutral, 1.0}));
  EXPECT_DOUBLE_EQ(heard_[0].duration, *interaction::wav_duration(folder_ / "audio" / heard_[0].audio));
  EXPECT_EQ(module_->health().state, "ready");
}

TEST_F(Sound, WithoutAVoiceTheWordsRemain) {
  ASSERT_TRUE(config_.set("sound.program=/nonexistent/voice"));
  start(false);
  say("t1/short", kText);
  wait_for_news();
  EXPECT_EQ(heard_[0].state, "speaking");
  EXPECT_EQ(heard_[0].audio, "");
  EXPECT_DOUBLE_EQ(heard_[0].duration, interaction::speech_duration(kText, "en", Mood::neutral));
  EXPECT_EQ(module_->health().state, "degraded");
  EXPECT_NE(module_->health().reason.find("/nonexistent/voice"), std::string::npos);
}

TEST_F(Sound, MutedItMakesNoSound) {
  limits_.publish({0.7, 0.0, "open", true});
  start(false);
  run_for(0.1);
  say("t1/short", kText);
  run_for(0.1);
  ASSERT_EQ(heard_.size(), 1U);
  EXPECT_EQ(heard_[0].audio, "");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "audio"));
}

TEST_F(Sound, TheHornHasAFileThatEverybodyCanFetch) {
  start(false);
  run_for(0.3);
  const interaction::HornSound horn = interaction::horn_sound(1.0);
  EXPECT_NEAR(interaction::wav_duration(folder_ / "audio" / horn.file).value_or(0.0), horn.duration_s, 0.001)
      << "before it sounds";
  limits_.publish({0.7, 0.3, "open", true});
  run_for(0.3);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "audio" / interaction::horn_sound(0.3).file))
      << "and in the volume of the hour";
  EXPECT_EQ(module_->health().state, "ready");
}

TEST_F(Sound, ThePlayerPlaysTheHornAndTheLines) {
  const auto notes = folder_ / "notes";
  ASSERT_TRUE(write_file_atomically(folder_ / "player", "#!/bin/sh\necho $1 >> " + notes.string() + "\n"));
  std::filesystem::permissions(folder_ / "player", std::filesystem::perms::owner_all);
  ASSERT_TRUE(config_.set("sound.player=" + (folder_ / "player").string()));
  start(false);
  const auto horn = listener_->publisher(topics::kHorn);
  const auto played = [&](const std::string& file) {
    for (int i = 0; i < 400; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      if (read_file(notes).value_or("").find((folder_ / "audio" / file).string()) != std::string::npos) return true;
    }
    return false;
  };
  horn.publish({});
  run_for(0.01);
  EXPECT_TRUE(played(interaction::horn_sound(1.0).file));
  say("t1/short", kText);
  wait_for_news();
  EXPECT_TRUE(played(heard_.back().audio));
  EXPECT_EQ(module_->health().state, "ready");
}

TEST_F(Sound, AMissingPlayerIsToldAndMutedItIsNotAsked) {
  ASSERT_TRUE(config_.set("sound.player=/nonexistent/player"));
  limits_.publish({0.7, 0.0, "open", true});
  start(false);
  const auto horn = listener_->publisher(topics::kHorn);
  run_for(0.1);
  horn.publish({});
  run_for(0.1);
  EXPECT_EQ(module_->health().state, "ready") << "muted";
  limits_.publish({0.7, 1.0, "open", true});
  horn.publish({});
  run_for(0.1);
  EXPECT_EQ(module_->health().state, "degraded");
  EXPECT_NE(module_->health().reason.find("/nonexistent/player"), std::string::npos);
}

TEST_F(Sound, DiesWhileItRendersWithoutWaiting) {
  ASSERT_TRUE(write_file_atomically(folder_ / "slow", "#!/bin/sh\nexec sleep 30\n"));
  std::filesystem::permissions(folder_ / "slow", std::filesystem::perms::owner_all);
  ASSERT_TRUE(config_.set("sound.program=" + (folder_ / "slow").string()));
  start(false);
  say("t1/short", kText);
  run_for(0.1);
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  const auto begin = std::chrono::steady_clock::now();
  kill();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(2));
  run_for(1.0);
}

}  // namespace
}  // namespace docent::modules
