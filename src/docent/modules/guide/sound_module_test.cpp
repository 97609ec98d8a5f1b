#include "docent/modules/guide/sound_module.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "docent/base/files.h"
#include "docent/interaction/sound/horn.h"
#include "docent/interaction/sound/levels_for_test.h"
#include "docent/interaction/sound/mixer.h"
#include "docent/interaction/sound/sound_file.h"
#include "docent/interaction/speech/renderer.h"
#include "docent/interaction/speech/repertoire.h"
#include "docent/interaction/speech/sentences.h"
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
    horn_ = listener_->publisher(topics::kHorn);
    task_ = listener_->publisher(topics::kTaskState);
    music_ = listener_->publisher(topics::kMusic);
    listener_->subscribe<docent_msgs::SoundState>(topics::kSoundState, [this](const auto& state) { sound_ = state; });
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
  void task(TaskStatus status) {
    docent_msgs::TaskState state;
    state.state = to_text(status);
    task_.publish(std::move(state));
  }
  void say(const std::string& id, const std::string& text) { say_.publish({id, text, "en", "neutral"}); }
  void run_for(double duration_s) { hub_.run_until(hub_.now() + seconds(duration_s)); }
  /// What was written by the output `file`.
  [[nodiscard]] std::vector<std::int16_t> mix() const {
    const auto clip = interaction::read_clip(folder_ / "sound.wav");
    EXPECT_TRUE(clip) << clip.error().message;
    std::vector<std::int16_t> samples;
    for (const float sample : clip.value_or(interaction::Clip{})) samples.push_back(interaction::to_pcm(sample));
    return samples;
  }
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
  transport::Publisher<docent_msgs::Horn> horn_;
  transport::Publisher<docent_msgs::TaskState> task_;
  transport::Publisher<docent_msgs::Music> music_;
  docent_msgs::SoundState sound_;
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
  EXPECT_EQ(heard_[0].audio, interaction::audio_file_name({kText, "en", Mood::neutral}));
  EXPECT_DOUBLE_EQ(heard_[0].duration, *interaction::sound_duration(folder_ / "audio" / heard_[0].audio));
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
  const interaction::SharedSound horn = interaction::horn_sound();
  EXPECT_NEAR(interaction::sound_duration(folder_ / "audio" / horn.file).value_or(0.0), horn.duration_s, 0.001)
      << "before it sounds";
  EXPECT_EQ(module_->health().state, "ready");
}

TEST_F(Sound, ThePagesAreToldTheVolumeOfTheHour) {
  museum_.sound.quiet_hours = {"10:00-11:00"};
  museum_.sound.quiet_volume = 0.25;
  start(true);
  run_for(0.3);
  EXPECT_DOUBLE_EQ(sound_.volume, 0.25) << "virtual time begins at ten";
  limits_.publish({0.7, 0.4, "open", true});
  run_for(0.3);
  EXPECT_DOUBLE_EQ(sound_.volume, 0.1);
  run_for(3600.0);
  EXPECT_DOUBLE_EQ(sound_.volume, 0.4);
}

TEST_F(Sound, MusicPlaysWhileTheTaskDrivesUnlessItIsOrdered) {
  ASSERT_TRUE(config_.set("sound.output=file"));
  start(true);
  run_for(0.3);
  EXPECT_EQ(sound_.music, "");
  task(TaskStatus::driving);
  run_for(0.3);
  ASSERT_NE(sound_.music, "");
  EXPECT_TRUE(interaction::sound_duration(folder_ / "audio" / sound_.music)) << "the pages can fetch it";
  EXPECT_NEAR(to_seconds(from_message(sound_.music_start)), 0.3, 0.11);
  const double alone = sound_.music_volume;
  say("t1/short", kText);
  run_for(0.3);
  EXPECT_NEAR(interaction::to_db(sound_.music_volume / alone), -interaction::MixerParams{}.duck_db, 0.01);
  run_for(30.0);
  EXPECT_DOUBLE_EQ(sound_.music_volume, alone) << "it is over";
  task(TaskStatus::explaining);
  run_for(0.3);
  EXPECT_EQ(sound_.music, "");
  docent_msgs::Music order;
  order.plays = true;
  music_.publish(order);
  run_for(0.3);
  EXPECT_NE(sound_.music, "") << "ordered, though nothing drives";
  order.plays = false;
  music_.publish(order);
  task(TaskStatus::driving);
  run_for(0.3);
  EXPECT_EQ(sound_.music, "") << "and stopped, though the robot drives";
}

TEST_F(Sound, MusicCanBeSwitchedOff) {
  ASSERT_TRUE(config_.set("sound.output=file"));
  ASSERT_TRUE(config_.set("sound.music=false"));
  start(true);
  task(TaskStatus::driving);
  run_for(0.5);
  EXPECT_EQ(sound_.music, "");
}

TEST_F(Sound, MusicThatCannotBePlayedIsTold) {
  museum_.sound.music = folder_ / "tune.wav";
  ASSERT_TRUE(config_.set("sound.output=file"));
  start(true);
  task(TaskStatus::driving);
  run_for(0.5);
  EXPECT_EQ(module_->health().state, "degraded");
  EXPECT_NE(module_->health().reason.find("tune.wav"), std::string::npos);
}

TEST_F(Sound, ARecordingIsHeardInItsOwnTime) {
  museum_.folder = folder_;
  museum_.languages = {"en"};
  const std::string please = interaction::sentence(interaction::Sentence::let_me_through, "en", Mood::neutral, 0);
  const auto recording = folder_ / "content/audio/en/let_me_through.neutral.1.wav";
  std::filesystem::create_directories(recording.parent_path());
  const interaction::SharedSound sound = interaction::shared_sound(interaction::sine(500.0, -20.0, 2.5));
  ASSERT_TRUE(write_file_atomically(recording, sound.content));
  ASSERT_TRUE(config_.set("sound.ahead=false"));
  start(false);
  say("p", please);
  wait_for_news();
  EXPECT_EQ(heard_[0].audio, sound.file);
  EXPECT_DOUBLE_EQ(heard_[0].duration, sound.duration_s);
  EXPECT_EQ(module_->health().state, "ready");
}

TEST_F(Sound, AMuseumsWordsAreRenderedAhead) {
  museum_.languages = {"en"};
  start(false);
  const auto first = interaction::repertoire(museum_).front().line;
  bool is_there = false;
  for (int i = 0; i < 1000 && !is_there; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    is_there = std::filesystem::exists(folder_ / "audio" / interaction::audio_file_name(first));
  }
  EXPECT_TRUE(is_there);
  EXPECT_TRUE(heard_.empty());
}

TEST_F(Sound, ACardThatIsMissingIsToldAndHindersNothing) {
  ASSERT_TRUE(config_.set("sound.output=card"));
  ASSERT_TRUE(config_.set("sound.device=hw:77"));
  start(false);
  horn_.publish({});
  say("t1/short", kText);
  wait_for_news();
  EXPECT_EQ(heard_.back().state, "speaking");
  EXPECT_NE(heard_.back().audio, "") << "the pages are heard";
  EXPECT_EQ(module_->health().state, "degraded");
  EXPECT_NE(module_->health().reason.find("hw:77"), std::string::npos);
}

TEST_F(Sound, RefusesAnUnknownOutput) {
  ASSERT_TRUE(config_.set("sound.output=radio"));
  bus_ = hub_.connect("sound");
  const auto module = make_sound({*bus_, museum_, config_, folder_, 1, true});
  ASSERT_FALSE(module);
  EXPECT_NE(module.error().message.find("sound.output"), std::string::npos);
}

/// The robot sets out with its horn, plays music, speaks, blows the horn at somebody and arrives. Its mix is measured.
class Drive : public Sound {
 protected:
  static constexpr double kDeparture = 1.0, kSpeech = 6.0, kPerson = 15.0, kArrival = 17.0, kEnd = 20.0;  // [s]
  /// Returns the samples of the whole drive.
  std::vector<std::int16_t> heard(const std::vector<std::string>& settings = {}) {
    kill();
    heard_.clear();
    for (const char* setting : {"sound.output=file", "sound.music=true"}) EXPECT_TRUE(config_.set(setting));
    for (const std::string& setting : settings) EXPECT_TRUE(config_.set(setting));
    const Time begin = hub_.now();
    const auto until = [&](double t) { hub_.run_until(begin + seconds(t)); };
    task(TaskStatus::done);
    until(0.001);  // what was latched before has been told
    start(true);
    until(kDeparture);
    horn_.publish({});
    task(TaskStatus::driving);
    until(kSpeech);
    say("line-" + std::to_string(hub_.now().nanoseconds), kText);
    until(kPerson);
    horn_.publish({});
    until(kArrival);
    task(TaskStatus::explaining);
    until(kEnd);
    EXPECT_FALSE(heard_.empty());
    speech_s_ = heard_.empty() ? 0.0 : heard_.front().duration;
    kill();
    return mix();
  }
  /// The strongest pitch [Hz], sought from 100 to 1000 Hz.
  static double pitch_of(std::span<const std::int16_t> samples) {
    double best = 0.0, level = -1e9;
    for (double pitch = 100.0; pitch <= 1000.0; pitch += 1.0) {
      if (const double here = interaction::goertzel_db(samples, pitch); here > level) {
        level = here;
        best = pitch;
      }
    }
    return best;
  }
  double speech_s_ = 0.0;
  const interaction::MixerParams levels_;
};

TEST_F(Drive, HornMusicAndSpeechAreHeard) {
  using interaction::level_db;
  using interaction::part;
  const auto samples = heard();
  ASSERT_NEAR(static_cast<double>(samples.size()) / interaction::kSampleRate, kEnd, 0.11);
  ASSERT_GT(speech_s_, 3.0);
  ASSERT_LT(kSpeech + speech_s_ + 2.0, kPerson);
  EXPECT_EQ(level_db(part(samples, 0.0, kDeparture - 0.01)), interaction::kSilence) << "silence is silence";

  for (const double begin : {kDeparture, kPerson}) {
    const auto blast = part(samples, begin + 0.01, begin + 0.21);
    const double pitch = pitch_of(blast);
    EXPECT_LT(std::min(std::abs(pitch - 349.23), std::abs(pitch - 440.0)), 5.0) << pitch << " Hz is no horn";
    EXPECT_NEAR(level_db(blast), levels_.horn_db, 2.5) << begin;
  }
  const double music = level_db(part(samples, kDeparture + 2.0, kSpeech - 0.1));
  EXPECT_NEAR(music, levels_.music_db, 3.0);
  EXPECT_GT(level_db(part(samples, kPerson + 0.01, kPerson + 0.21)), music + 12.0) << "the horn over music";

  const auto spoken = part(samples, kSpeech + 0.3, kSpeech + speech_s_ - 0.3);
  EXPECT_NEAR(level_db(spoken), levels_.speech_db, 3.0);
  EXPECT_NEAR(level_db(part(samples, kSpeech + speech_s_ + 1.5, kPerson - 0.1)), levels_.music_db, 3.0)
      << "music comes back";
  EXPECT_EQ(level_db(part(samples, kArrival + levels_.fade_s + 0.2, kEnd - 0.2)), interaction::kSilence)
      << "the robot has arrived";
  int most = 0;
  for (const std::int16_t sample : samples) most = std::max(most, std::abs(static_cast<int>(sample)));
  EXPECT_LT(most, 32767) << "it clips";
}

TEST_F(Drive, SpeechLiesFarAboveTheMusicUnderIt) {
  const auto with = heard();
  const auto without = heard({"sound.music=false"});
  ASSERT_EQ(with.size(), without.size());
  std::vector<std::int16_t> music(with.size());
  for (std::size_t i = 0; i < with.size(); ++i) music[i] = static_cast<std::int16_t>(with[i] - without[i]);
  const double begin = kSpeech + 0.4, end = kSpeech + speech_s_ - 0.2;
  const double under = interaction::level_db(interaction::part(music, begin, end));
  EXPECT_GT(interaction::level_db(interaction::part(without, begin, end)) - under, 20.0) << "WCAG 1.4.7";
  EXPECT_GT(under, -60.0) << "it plays on";
}

TEST_F(Drive, QuietHoursAreQuieterThroughout) {
  const auto usual = heard();
  museum_.sound.quiet_hours = {"00:00-24:00"};
  museum_.sound.quiet_volume = 0.25;  // 12 dB less
  const auto quiet = heard();
  for (const double at : {kDeparture, kDeparture + 3.0, kSpeech + 1.0, kPerson}) {
    const double by = interaction::level_db(interaction::part(usual, at + 0.01, at + 0.2)) -
                      interaction::level_db(interaction::part(quiet, at + 0.01, at + 0.2));
    EXPECT_NEAR(by, 12.0, 1.5) << at;
  }
}

TEST_F(Drive, TheSameDriveSoundsTheSame) { EXPECT_EQ(heard(), heard()); }

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
